#pragma once

#include <vector>

#include "fluid/solver.hpp"
#include "validation/support/case.hpp"

namespace sluice::validation {

// The liquid at one of the times of the paper's pictures [ms after the jet has come to the core].
struct MouldPicture {
  double time;
  fluid::Snapshot state;
};

// Of a jet of half width a/2 that a cylinder of radius a splits, free_streamline.py 0.5: force over rho U^2
// b, and the angle [degrees] that either half is turned by.
inline constexpr double kSplitJetForce = 0.338, kSplitJetAngle = 48.55;

struct MouldFillingRun {
  Outcome outcome;
  std::vector<MouldPicture> pictures;
};

// A resolution counts particles over the gate's width b, and is even.
MouldFillingRun run_mould_filling(int resolution, const std::vector<std::string>& overrides, int threads);

Case mould_filling();

}  // namespace sluice::validation
