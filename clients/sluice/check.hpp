#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "clients/preflight/preflight.hpp"

namespace sluice::clients {

struct CheckOptions {
  std::filesystem::path scene;
  std::vector<std::string> overrides;  // PATH=VALUE
};

// Loads the scene and looks for what cannot work; warnings go to the log. Throws SceneError with every
// problem.
Estimate require_sound(const CheckOptions& options);

// "10000 fluid and 4062 boundary particles, 7725 steps, 35 MB, about 0:38 on one thread"
std::string to_string(const Estimate& estimate);

// Prints what the scene will cost. Returns the exit code; throws SceneError.
int check(const CheckOptions& options);

}  // namespace sluice::clients
