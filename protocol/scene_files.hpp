#pragma once

#include <filesystem>

#include "protocol/scene_parse.hpp"

namespace sluice::protocol {

// Reads the files that a scene names, which lie beside it, into the scene, and removes their names: what
// travels and is recorded is whole. Problems are reported in `parsed`.
void read_named_files(const std::filesystem::path& scene_file, ParsedScene& parsed);

}  // namespace sluice::protocol
