#pragma once

#include <filesystem>
#include <vector>

#include "protocol/scene_file.hpp"

namespace sluice::protocol {

// Reads a table of keyframes (scene.proto, Keyframes.file) for a scene of that dimension and appends its
// keys. What is wrong with the table is reported with its line and column; `field` is that of the scene.
void read_motion_table(const std::filesystem::path& path, const std::string& field, int dimension,
                       Keyframes& keyframes, std::vector<Problem>& problems);

}  // namespace sluice::protocol
