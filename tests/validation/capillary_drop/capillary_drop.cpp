#include "validation/capillary_drop/capillary_drop.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "validation/support/budget.hpp"
#include "validation/support/files.hpp"
#include "validation/support/oscillation.hpp"
#include "validation/support/scene_run.hpp"

namespace sluice::validation {
namespace {

// Of the scenes.
constexpr double kRadius = 1e-2, kDensity = 1000, kTension = 0.072;  // [m], [kg/m^3], [N/m]
constexpr double kViscosity = 1e-3;                                  // of the still drop [Pa s]
constexpr double kSurface = 2 * M_PI * kRadius;                      // of the disc [m]

SceneRun make_run(const char* scene, int resolution, const std::vector<std::string>& overrides, int threads) {
  return SceneRun(case_file(std::string("capillary_drop/") + scene),
                  with_spacing(kRadius / resolution, overrides), threads);
}

// Mean pressure within half the radius [Pa].
double inner_pressure(const SceneRun& run) {
  const fluid::Snapshot s = run.solver().snapshot();
  double sum = 0;
  int count = 0;
  for (std::size_t i = 0; i < s.density.size(); ++i) {
    if (std::hypot(s.position[3 * i], s.position[3 * i + 1]) > kRadius / 2) continue;
    sum += s.pressure[i];
    ++count;
  }
  return sum / count;
}

// The figures are of the second half of the run.
Outcome run_still(int resolution, const std::vector<std::string>& overrides, int threads) {
  SceneRun run = make_run("still_drop.scene", resolution, overrides, threads);
  EnergyRise rise(run);
  double pressure = 0, kinetic = 0;
  int outputs = 0;
  while (run.next_output()) {
    rise.look(run);
    if (run.time() < run.end_time() / 2) continue;
    pressure += inner_pressure(run);
    kinetic += run.solver().diagnostics().kinetic;
    ++outputs;
  }
  kinetic /= outputs;
  const double error = std::abs(pressure / outputs / (kTension / kRadius) - 1);
  const double speed = std::sqrt(2 * kinetic / (kDensity * M_PI * kRadius * kRadius));  // rms
  return run.outcome({{"pressure inside", "% from Laplace", 100 * error, 5},
                      {"kinetic energy", "% of sigma 2 pi R", 100 * kinetic / (kTension * kSurface)},
                      {"capillary number of rms speed", "1e-6", 1e6 * kViscosity * speed / kTension},
                      {"energy rises by", "% of sigma 2 pi R", 100 * rise.most() / (kTension * kSurface)}},
                     error);
}

// Logarithm of the length along x over that across, from the second moments of the particles.
double stretch(const SceneRun& run) {
  const fluid::Snapshot s = run.solver().snapshot();
  Eigen::Array3d first = Eigen::Array3d::Zero(), second = Eigen::Array3d::Zero();
  double mass = 0;
  for (std::size_t i = 0; i < s.density.size(); ++i) {
    const Eigen::Array3d x(s.position[3 * i], s.position[3 * i + 1], s.position[3 * i + 2]);
    mass += run.masses()[i];
    first += run.masses()[i] * x;
    second += run.masses()[i] * x.square();
  }
  const Eigen::Array3d moment = second / mass - (first / mass).square();
  const bool plane = run.scene().dimension() == 2;
  return 0.5 * std::log(moment[0] / (plane ? moment[1] : 0.5 * (moment[1] + moment[2])));
}

// `squared` is omega^2 rho R^3 / sigma.
Outcome run_oscillation(const char* scene, double squared, int resolution,
                        const std::vector<std::string>& overrides, int threads) {
  SceneRun run = make_run(scene, resolution, overrides, threads);
  const double omega = std::sqrt(squared * kTension / (kDensity * std::pow(kRadius, 3)));
  const double start = stretch(run);
  EnergyRise rise(run);
  Curve curve{{0.0}, {1.0}};
  while (run.next_output()) {
    rise.look(run);
    curve.x.push_back(run.time());
    curve.y.push_back(stretch(run) / start);
  }
  const Oscillation found = fit_oscillation(curve, {.frequency = omega, .cosine = 1});
  const double error = std::abs(omega / found.frequency - 1);
  const double left = std::exp(-found.decay * 2 * M_PI / omega);
  return run.outcome({{"period", "% from Rayleigh", 100 * error, 5},
                      {"amplitude left after a period", "%", 100 * left},
                      {"energy rises by", "% of that at the start", 100 * rise.most() / rise.start()}},
                     error);
}

}  // namespace

Case still_drop() {
  return {.name = "still_drop",
          .title = "Drop at rest under surface tension, particles over R",
          .reference = "pressure sigma/R, Laplace 1806",
          .resolutions = {10, 20, 40},
          .quick = {10},
          .bound_resolution = 40,
          .run = run_still};
}

Case oscillating_drop() {
  return {.name = "oscillating_drop",
          .title = "Oscillating drop, mode 2, three periods, particles over R",
          .reference = "omega^2 = 6 sigma/(rho R^3), Rayleigh 1879",
          .resolutions = {10, 20, 40},
          .quick = {10},
          .bound_resolution = 40,
          .run = [](int resolution, const std::vector<std::string>& overrides, int threads) {
            return run_oscillation("oscillating_drop.scene", 6, resolution, overrides, threads);
          }};
}

Case oscillating_drop_3d() {
  return {.name = "oscillating_drop_3d",
          .title = "Oscillating drop in space, mode 2, two periods, particles over R",
          .reference = "omega^2 = 8 sigma/(rho R^3), Rayleigh 1879",
          .resolutions = {6, 8, 10},
          .quick = {6},
          .bound_resolution = 10,
          .run = [](int resolution, const std::vector<std::string>& overrides, int threads) {
            return run_oscillation("oscillating_drop_3d.scene", 8, resolution, overrides, threads);
          }};
}

}  // namespace sluice::validation
