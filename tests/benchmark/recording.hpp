#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace sluice::benchmark {

struct RecordingOptions {
  double particles = 20'000;
  int pairs = 9;       // of runs with and without a recorder
  bool quick = false;  // fewer frames; nothing is stated of those
  std::string csv;     // file; empty: none
};

// What frames cost the server, by pairs of runs of one scene, with a recorder and without.
struct FrameCost {
  double rate = 0;                      // frames per simulated second
  std::uint64_t frames = 0, steps = 0;  // of a run
  std::vector<double> without;  // processor time of the server's process, all threads, of each pair [s]
  std::vector<double> with;     // the same with a recorder
};

// Of the pairs: with over without, less 1.
struct Share {
  double median = 0, lower = 0, upper = 0;  // lower and upper quartile
};
Share share_of(const FrameCost& cost);
// Processor time a frame [s], the median over the pairs.
double seconds_per_frame(const FrameCost& cost);

// Prints the table, writes the file. Returns the exit code: 1 when a frame costs more than what is stated.
// Throws std::runtime_error when a process fails.
int recording(const RecordingOptions& options);

}  // namespace sluice::benchmark
