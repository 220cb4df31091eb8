#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "clients/sluice/check.hpp"

namespace sluice::clients {

struct RunOptions {
  CheckOptions check;            // the scene and its overrides
  std::optional<double> until;   // simulated [s]
  std::filesystem::path output;  // empty: nothing is recorded
  bool force = false;            // replace an existing recording
  int threads = 0;               // 0: the server's default
  std::string listen;            // empty: a private endpoint
  std::filesystem::path keys;
  bool json = false;
  bool verbose = false;
};

// Checks the scene and everything the run needs, starts its processes, follows them to the end and reports.
// Returns the exit code. Throws InputError before anything has been started or written.
int run(const RunOptions& options);

}  // namespace sluice::clients
