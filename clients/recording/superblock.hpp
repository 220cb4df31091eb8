#pragma once

#include <cstdint>
#include <filesystem>

namespace sluice::clients {

// What the first bytes of an HDF5 file say about how it was left (HDF5 File Format Specification 3.0, II.A).
struct Superblock {
  bool open_for_writing = false;  // by a writer that is alive or was killed
  bool open_for_swmr = false;     // likewise, one that lets others read
  bool cut_short = false;         // the file is shorter than it says
};

// Throws InputError when the file is absent, cannot be read, is no HDF5 file or of a version that recordings
// never have.
Superblock read_superblock(const std::filesystem::path& path);

}  // namespace sluice::clients
