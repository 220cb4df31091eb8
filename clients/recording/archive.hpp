#pragma once

#include <filesystem>
#include <string>

namespace sluice::clients {

// Writes a compressed copy of a finished recording: the same rows bit for bit, for every program that reads
// the other. Returns a line for people. Throws InputError when the recording is not finished or not whole, or
// the copy cannot be written; then there is no copy.
std::string archive(const std::filesystem::path& recording, const std::filesystem::path& copy, bool force);

}  // namespace sluice::clients
