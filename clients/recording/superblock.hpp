#pragma once

#include <filesystem>

namespace sluice::clients {

// What the first bytes of an HDF5 file say about how it was left (HDF5 File Format Specification 3.0, II.A).
enum class FileState {
  kClosed,         // by its writer
  kOpenForSwmr,    // a writer with readers has it open, or was killed
  kOpenForWriter,  // a writer has it open in a state that nobody else can read, or was killed
};

// Throws InputError when the file is absent, cannot be read, is no HDF5 file or of a version that recordings
// never have.
FileState file_state(const std::filesystem::path& path);

}  // namespace sluice::clients
