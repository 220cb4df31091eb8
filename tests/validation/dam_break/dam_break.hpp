#pragma once

#include "validation/support/case.hpp"
#include "validation/support/curve.hpp"

namespace sluice::validation {

struct DamBreakRun {
  Outcome outcome;
  // Over T = t sqrt(2g/a): the front over a until it nears the far wall; the energy over its start to the
  // end.
  Curve front, energy;
};

// The shipped scene with `resolution` particles over the column's width a.
DamBreakRun run_dam_break(int resolution, const std::vector<std::string>& overrides, int threads);

// A measured front; one of the three names of dam_break.cpp.
struct Experiment {
  std::string name;
  Curve front;
};
const std::vector<Experiment>& dam_break_experiments();

// Of a front over a and T, for T > 1 as far as there are two experiments.
struct FrontError {
  double ahead = 0, behind = 0;  // largest distance outside the experiments' scatter, over the front
  double rms = 0;                // from their mean, over the mean
};
FrontError compare_with_experiments(const Curve& front);

Case dam_break();

}  // namespace sluice::validation
