#pragma once

#include <filesystem>
#include <string>

#include "clients/recording/copy.hpp"

namespace sluice::clients {

struct Repair {
  Extent found, kept;
  // Where the recording is now, and where the damaged one; both empty when nothing was wrong.
  std::filesystem::path repaired, original;
};

// Makes a recording that every program opens out of one whose recorder was killed or that is damaged: all
// frames and exchanges before the first that is not what was written. It takes the place of the other, which
// is kept as RUN.damaged.h5; with an `output` it goes there and the other stays. A recording that is whole is
// left alone. Throws InputError when it is still being written, when nothing can be read, or when a file is
// in the way.
Repair repair(const std::filesystem::path& recording, const std::filesystem::path& output);

// For people.
std::string to_text(const Repair& repair, const std::filesystem::path& recording);

}  // namespace sluice::clients
