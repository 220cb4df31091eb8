#pragma once

#include <string>
#include <vector>

#include "fluid/solver.hpp"

namespace sluice::benchmark {

struct SpeedOptions {
  std::vector<std::string> cases;  // all when empty
  std::vector<double> particles;   // instead of the cases' own
  std::vector<int> threads{1, 2};
  bool quick = false;    // the smallest of each case, for a tenth of the time
  std::string csv;       // file; empty: none
  std::string baseline;  // an earlier csv to compare with; empty: none
  std::string plot;      // picture; empty: none
};

// What a scene cost.
struct SpeedRow {
  std::string scene;
  std::uint64_t particles = 0;  // of fluid
  int threads = 1;
  double rate = 0;       // fluid particles times steps over the wall clock of the stepping [1/s]
  double neighbors = 0;  // fluid within the support of a fluid particle, itself not counted, on average
  double share = 0;      // floating-point operations on those pairs, of the peak of the threads' cores
  double bytes = 0;      // that the process grew by, a fluid particle
  double growth = 1;     // time a particle step over that of the case's smallest
  // Not read back:
  double start = 0;            // wall clock of the start-up over that of a step
  double most_bytes = 0;       // as bytes, the most that there was, start-up included
  fluid::StageTimes stages{};  // of the timed steps, wall clock [s]
};

// Prints the table, writes the files. Returns the exit code. Throws InputError for a case that does not exist
// or a file that cannot be read or written.
int speed(const SpeedOptions& options);

std::string to_csv(const std::vector<SpeedRow>& rows);
// Rows of a file that to_csv wrote. Throws InputError naming the line that cannot be read.
std::vector<SpeedRow> read_speed_csv(const std::string& path);

}  // namespace sluice::benchmark
