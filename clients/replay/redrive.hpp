#pragma once

#include <atomic>
#include <string>

#include "clients/recording/reader.hpp"

namespace sluice::clients {

struct RedriveResult {
  bool identical = false;
  std::string text;  // "identical", or the first step or frame and field that differ, with both values
};

// Runs the fluid again: starts a server with the recorded scene, plays the rigid process with the recorded
// kinematics, and compares what the server would record with what was recorded, bit by bit. `threads` 0: as
// many as were recorded. Throws std::runtime_error when the server fails, InputError when the recording is
// empty.
RedriveResult redrive(const Reader& recording, int threads, const std::atomic<bool>& stop);

}  // namespace sluice::clients
