#pragma once

#include <string>
#include <vector>

namespace sluice::benchmark {

struct AccuracyOptions {
  std::vector<std::string> cases, formulations;  // empty: all cases; the defaults
  bool quick = false;
  std::vector<int> resolutions;  // empty: those of the case
  int threads = 1;
  std::string csv, plot;  // files; empty: none
};

// Runs the cases, prints their tables, writes the files. Returns the exit code: 1 when the defaults miss a
// bound. Throws InputError for a name that does not exist or a file that cannot be written.
int accuracy(const AccuracyOptions& options);

}  // namespace sluice::benchmark
