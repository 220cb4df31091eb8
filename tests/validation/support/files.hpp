#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace sluice::validation {

// A file of the cases, e.g. "dam_break/dam_break.scene": beside the programs, in ../share/sluice/validation.
std::filesystem::path case_file(const std::string& name);

// One of the scenes that sluice comes with, without ending, e.g. "dam_break".
std::filesystem::path shipped_scene(const std::string& name);

// The overrides that give this spacing [m], before others.
std::vector<std::string> with_spacing(double spacing, const std::vector<std::string>& overrides);

}  // namespace sluice::validation
