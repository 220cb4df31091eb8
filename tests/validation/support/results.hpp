#pragma once

#include <string>

namespace sluice::validation {

// Where the tests leave their figures: the build tree's validation folder.
inline std::string result_file(const std::string& name) {
  return std::string(SLUICE_RESULTS) + "/" + name;
}

}  // namespace sluice::validation
