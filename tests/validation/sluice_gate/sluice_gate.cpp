#include "validation/sluice_gate/sluice_gate.hpp"

#include <cmath>

#include "validation/support/files.hpp"
#include "validation/support/scene_run.hpp"

namespace sluice::validation {
namespace {

// Of the scene [m], and when the flow has become steady [s].
constexpr double kOpening = 0.1, kDepth = 0.5, kGate = 1.5, kSteady = 2;
// Where the depths are measured: halfway to the gate, and behind it where the jet is as thin as it gets [m].
constexpr double kInFront[2] = {0.5, 1.0}, kBehind[2] = {kGate + 2 * kOpening, kGate + 4 * kOpening};

// Mean depth [m] of the liquid between two places.
double depth_between(const fluid::Snapshot& state, double particle_mass, const double (&range)[2]) {
  double volume = 0;
  for (std::size_t i = 0; i < state.density.size(); ++i)
    if (state.position[3 * i] > range[0] && state.position[3 * i] < range[1])
      volume += particle_mass / state.density[i];
  return volume / (range[1] - range[0]);
}

// q = Cd a sqrt(2 g h0) with Cd = Cc / sqrt(1 + Cc a/h0), by Bernoulli's equation from the depth h0 in front
// to the depth Cc a behind. Without friction and gravity on the jet Cc = pi/(pi + 2) = 0.611 (Kirchhoff);
// with it 0.602 at a/h0 = 0.2 (F. Henderson, Open Channel Flow, 1966, after potential theory).
constexpr double kContraction = 0.602;

// Fitted to H. Henry's measurements of free flow (P. Swamee, J. Irrig. Drain. Eng. 118, 1992, eq. 4).
double measured_coefficient(double a, double h0) {
  return 0.611 * std::pow((h0 - a) / (h0 + 15 * a), 0.072);
}

Outcome run(int resolution, const std::vector<std::string>& overrides, int threads) {
  SceneRun run(shipped_scene("sluice_gate"), with_spacing(kOpening / resolution, overrides), threads);
  double in_front = 0, behind = 0, from = 0, left = 0;
  int outputs = 0;
  while (run.next_output()) {
    if (run.time() < kSteady) continue;
    const fluid::Snapshot state = run.solver().snapshot();
    in_front += depth_between(state, run.simulation().particle_masses[0], kInFront);
    behind += depth_between(state, run.simulation().particle_masses[0], kBehind);
    const double mass = run.solver().diagnostics().openings.at(1).mass_out;
    if (outputs++ == 0) from = run.time(), left = mass;
    if (run.time() >= run.end_time() - 1e-9) left = (mass - left) / (run.time() - from);
  }
  in_front /= outputs;
  behind /= outputs;
  const double rho0 = run.scene().liquid().density();
  const double coefficient = left / rho0 / kOpening / std::sqrt(2 * 9.81 * kDepth);
  const double theory = kContraction / std::sqrt(1 + kContraction * kOpening / kDepth);
  const double error = std::abs(coefficient / theory - 1);
  return run.outcome(
      {{"discharge coefficient", "", coefficient},
       {"from potential theory", "%", 100 * error, 5},
       {"from measurements", "%", 100 * std::abs(coefficient / measured_coefficient(kOpening, kDepth) - 1),
        5},
       {"depth behind over the opening", "", behind / kOpening},
       {"contraction", "% from 0.602", 100 * std::abs(behind / kOpening / kContraction - 1), 5},
       {"depth in front", "% from the level", 100 * std::abs(in_front / kDepth - 1), 2}},
      error);
}

}  // namespace

Case sluice_gate() {
  return {.name = "sluice_gate",
          .title = "Sluice gate, a/h0 = 0.2, discharge from 2 to 6 s, particles over a",
          .reference = "potential theory; Henry 1950 in Swamee 1992",
          .resolutions = {5, 10},
          .quick = {5},
          .bound_resolution = 10,
          .run = run};
}

}  // namespace sluice::validation
