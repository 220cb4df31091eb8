#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "clients/sluice/check.hpp"

namespace sluice::clients {

struct RunOptions {
  CheckOptions check;  // the scene and its overrides; not of a run that is resumed
  // What such a run goes on from, and its recording so far; empty when it was not recorded.
  std::filesystem::path resume, recording;
  std::optional<double> until;   // simulated [s]
  std::filesystem::path output;  // empty: nothing is recorded
  bool force = false;            // replace an existing recording
  // Simulated time between checkpoints [s]; 0: the server's default. They stand beside the output.
  double checkpoint_every = 0;
  int threads = 0;     // 0: the server's default
  std::string listen;  // empty: a private endpoint
  std::filesystem::path keys;
  bool json = false;
  bool verbose = false;
};

// Checks the scene and everything the run needs, starts its processes, follows them to the end and reports.
// Returns the exit code. Throws InputError before anything has been started or written.
int run(const RunOptions& options);

// Goes on from options.resume, likewise. Nothing of the scene can be changed.
int resume(RunOptions options);

// Where the checkpoints of a run stand: RUN.checkpoint beside RUN.h5; empty when it is not recorded.
std::filesystem::path checkpoint_of(const std::filesystem::path& recording);

}  // namespace sluice::clients
