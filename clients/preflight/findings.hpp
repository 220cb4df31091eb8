#pragma once

#include <string>

#include "clients/preflight/preflight.hpp"

namespace sluice::clients {

// Collects problems together with where they stand in the file.
class Findings {
 public:
  explicit Findings(const protocol::SceneFile& file) : file_(file) {}

  void error(const std::string& field, const std::string& text) {
    result.errors.push_back({file_.locate(field), field, text});
  }
  void warning(const std::string& field, const std::string& text) {
    result.warnings.push_back({file_.locate(field), field, text});
  }

  Preflight result;

 private:
  const protocol::SceneFile& file_;
};

}  // namespace sluice::clients
