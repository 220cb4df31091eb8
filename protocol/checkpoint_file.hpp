#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "checkpoint.pb.h"

namespace sluice::protocol {

// The state of a run on disk (README.md, "Checkpoints").
struct CheckpointFile {
  Checkpoint header;
  std::vector<std::byte> fluid;
  std::vector<double> rigid;
};

// run.checkpoint -> run.previous.checkpoint, which holds the one before.
std::filesystem::path previous_checkpoint(const std::filesystem::path& path);

// Throws InputError when the file is absent, no checkpoint, of a newer format or damaged; the text names the
// one before it, if there is one.
CheckpointFile read_checkpoint(const std::filesystem::path& path);

// The file at `path` is the old or the new one whenever this process ends, and whole: it is written aside,
// synchronised and renamed. What stands there of the same run becomes the previous one. Throws
// std::system_error when it cannot be written.
void write_checkpoint(const std::filesystem::path& path, CheckpointFile& file);

}  // namespace sluice::protocol
