#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/error.hpp"
#include "scene.pb.h"

namespace sluice::protocol {

// Where something stands in a scene file; line and column from 1, 0 when unknown (JSON, --set).
struct Location {
  std::string file;
  int line = 0;
  int column = 0;
};

// One thing that is wrong: `field` is its path, e.g. "body[0].position"; `text` names the value, what is
// allowed and what to do.
struct Problem {
  Location where;
  std::string field;
  std::string text;
};

// "rising_gate.scene:12:3: body[0].density: -5 kg/m^3 is not positive; ..."
std::string to_string(const Problem& problem);

class SceneError : public InputError {
 public:
  explicit SceneError(std::vector<Problem> problems);
  // Of one problem whose place is not known.
  SceneError(std::string field, std::string text);
  [[nodiscard]] const std::vector<Problem>& problems() const { return problems_; }

 private:
  std::vector<Problem> problems_;
};

// A scene with the positions of its fields in the file.
class SceneFile {
 public:
  // Reads textproto, or JSON when the name ends in .json; applies "path=value" overrides ("spacing=0.002",
  // "body[0].density=500", "liquid.viscosity=1e-3"); then validates. Throws SceneError with every problem.
  static SceneFile load(const std::filesystem::path& path, const std::vector<std::string>& overrides = {});

  [[nodiscard]] const Scene& scene() const { return scene_; }
  // The position of a field by its path, or of its nearest ancestor that is in the file.
  [[nodiscard]] Location locate(std::string_view field) const;

 private:
  Scene scene_;
  std::string file_;
  std::map<std::string, Location, std::less<>> positions_;
};

}  // namespace sluice::protocol
