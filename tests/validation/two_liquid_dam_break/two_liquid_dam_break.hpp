#pragma once

#include "validation/support/case.hpp"
#include "validation/support/curve.hpp"

namespace sluice::validation {

struct TwoLiquidDamBreakRun {
  Outcome outcome;
  // Way of the fronts over a from their end walls, until they meet, and the energy over its start, over
  // T = t sqrt(2g/a).
  Curve light, heavy, energy;
};

// The shipped scene with `resolution` particles over the columns' width a.
TwoLiquidDamBreakRun run_two_liquid_dam_break(int resolution, const std::vector<std::string>& overrides,
                                              int threads);

Case two_liquid_dam_break();

}  // namespace sluice::validation
