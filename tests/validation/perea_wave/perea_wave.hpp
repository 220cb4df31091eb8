#pragma once

#include "fluid/solver.hpp"
#include "validation/support/case.hpp"

namespace sluice::validation {

struct PereaWaveRun {
  Outcome outcome;
  std::vector<double> times;            // [s]
  std::vector<fluid::Snapshot> states;  // then
};

// A resolution counts particles over the wave's length, and is a multiple of ten.
PereaWaveRun run_perea_wave(int resolution, const std::vector<std::string>& overrides, int threads);

Case perea_wave();

}  // namespace sluice::validation
