#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "protocol/scene_file.hpp"

namespace sluice::clients {

struct CheckOptions {
  std::filesystem::path scene;
  std::vector<std::string> overrides;  // PATH=VALUE
};

// Loads the scene and looks for what cannot work; warnings go to the log. Throws SceneError with every
// problem.
protocol::SceneFile load_checked(const CheckOptions& options);

// Prints what the scene will cost. Returns the exit code; throws SceneError.
int check(const CheckOptions& options);

}  // namespace sluice::clients
