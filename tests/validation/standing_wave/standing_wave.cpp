#include "validation/standing_wave/standing_wave.hpp"

#include <fmt/format.h>

#include <cmath>

#include "validation/support/files.hpp"
#include "validation/support/oscillation.hpp"
#include "validation/support/scene_run.hpp"

namespace sluice::validation {
namespace {

// Of the scene.
constexpr double kG = 9.81, kDepth = 1;  // [m/s^2], [m]
constexpr double kWaveNumber = M_PI / kDepth;
constexpr double kSteepness = 0.05 * kDepth * kWaveNumber;  // kA
constexpr double kPeriods = 5;

double linear_frequency() {
  return std::sqrt(kG * kWaveNumber * std::tanh(kWaveNumber * kDepth));
}

// Frequency over the linear one at steepness kA: I. Tadjbakhsh, J. B. Keller, J. Fluid Mech. 8, 1960,
//   1 + (kA)^2/64 (9 w^-8 - 12 w^-4 - 3 - 2 w^4),  w^2 = tanh(kH); 1 - (kA)^2/8 in deep water.
double nonlinear_ratio(double steepness) {
  const double w4 = std::pow(std::tanh(kWaveNumber * kDepth), 2);
  return 1 + steepness * steepness / 64 * (9 / (w4 * w4) - 12 / w4 - 3 - 2 * w4);
}

// First spatial mode of the water's height: sum of m y cos(kx).
double mode(const SceneRun& run) {
  const fluid::Snapshot s = run.solver().snapshot();
  double sum = 0;
  for (std::size_t i = 0; i < s.density.size(); ++i)
    sum += run.masses()[i] * s.position[3 * i + 1] * std::cos(kWaveNumber * s.position[3 * i]);
  return sum;
}

// The mode over its start, for the first five periods.
Oscillation measure(SceneRun& run) {
  const double start = mode(run);
  const double last = kPeriods * 2 * M_PI / linear_frequency();
  Curve curve{{0.0}, {1.0}};
  while (run.next_output() && run.time() <= last) {
    curve.x.push_back(run.time());
    curve.y.push_back(mode(run) / start);
  }
  return fit_oscillation(curve, {.frequency = linear_frequency(), .cosine = 1});
}

SceneRun make_run(double viscosity, int resolution, const std::vector<std::string>& overrides, int threads) {
  std::vector<std::string> all = with_spacing(kDepth / resolution, overrides);
  all.push_back(fmt::format("liquid.viscosity={}", viscosity));
  return SceneRun(case_file("standing_wave/standing_wave.scene"), all, threads);
}

// The period against the mean over the run: the amplitude that the nonlinear period belongs to decays.
Figure period_error(const Oscillation& found, double amplitude_left) {
  const double mean_steepness = kSteepness * 0.5 * (1 + amplitude_left);
  const double reference = linear_frequency() * nonlinear_ratio(mean_steepness);
  return {"period", "% from theory at this height", 100 * std::abs(reference / found.frequency - 1), 0.3};
}

Outcome run_inviscid(int resolution, const std::vector<std::string>& overrides, int threads) {
  SceneRun run = make_run(0, resolution, overrides, threads);
  const Oscillation found = measure(run);
  const double left = std::exp(-found.decay * kPeriods * 2 * M_PI / found.frequency);
  return run.outcome({period_error(found, left),
                      {"period over linear", "% longer", 100 * (linear_frequency() / found.frequency - 1)},
                      {"amplitude left after 5 periods", "%", 100 * left, 97, true}},
                     1 - left);
}

// Re = H sqrt(gH)/nu = 2500. Slip walls have no boundary layers, so that the motion decays as that of
// deep water with the potential flow's dissipation, exp(-2 nu k^2 t): H. Lamb, Hydrodynamics, art. 348.
Outcome run_viscous(int resolution, const std::vector<std::string>& overrides, int threads) {
  const double nu = kDepth * std::sqrt(kG * kDepth) / 2500, rho0 = 1000;
  SceneRun run = make_run(rho0 * nu, resolution, overrides, threads);
  const Oscillation found = measure(run);
  const double left = std::exp(-found.decay * kPeriods * 2 * M_PI / found.frequency);
  const double theory = 2 * nu * kWaveNumber * kWaveNumber;
  const double error = std::abs(found.decay / theory - 1);
  return run.outcome({{"decay rate", "% from theory", 100 * error, 5},
                      period_error(found, left),
                      {"amplitude left after 5 periods", "%", 100 * left}},
                     error);
}

}  // namespace

Case standing_wave() {
  return {.name = "standing_wave",
          .title = "Standing wave, amplitude 0.05 H, five periods, particles over H",
          .reference = "Tadjbakhsh & Keller 1960; inviscid, all of the amplitude is left",
          .resolutions = {12, 25, 50},
          .quick = {10},
          .bound_resolution = 50,
          .least_order = 1.8,
          .run = run_inviscid};
}

Case viscous_standing_wave() {
  return {.name = "viscous_standing_wave",
          .title = "Standing wave at H sqrt(gH)/nu = 2500, five periods, particles over H",
          .reference = "decay 2 nu k^2, Lamb 1932",
          .resolutions = {12, 25, 50},
          .quick = {10},
          .bound_resolution = 50,
          .least_order = 1.8,
          .run = run_viscous};
}

}  // namespace sluice::validation
