#include "validation/elliptical_drop/elliptical_drop.hpp"

#include <Eigen/Core>
#include <cmath>

#include "validation/support/files.hpp"
#include "validation/support/scene_run.hpp"

namespace sluice::validation {
namespace {

constexpr double kRate = 100;  // A of the scene [1/s]

// An ellipse of incompressible liquid with the velocity (-A x, A y): its semi-axes over R, and A.
using Ellipse = Eigen::Vector3d;  // a, b, A

// a' = -A a, b' = A b; the pressure rho/2 ((A' - A^2) x^2 - (A' + A^2) y^2) + const vanishes along the whole
// surface when A' = A^2 (a^2 - b^2)/(a^2 + b^2).
Ellipse rate(const Ellipse& e) {
  const double a2 = e[0] * e[0], b2 = e[1] * e[1];
  return {-e[2] * e[0], e[2] * e[1], e[2] * e[2] * (a2 - b2) / (a2 + b2)};
}

Ellipse exact(double time) {
  constexpr int kSteps = 10'000;
  const double dt = time / kSteps;
  Ellipse e(1, 1, kRate);
  for (int step = 0; step < kSteps; ++step) {  // classical Runge-Kutta
    const Ellipse k1 = rate(e), k2 = rate(e + dt / 2 * k1), k3 = rate(e + dt / 2 * k2),
                  k4 = rate(e + dt * k3);
    e += dt / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  }
  return e;
}

// Semi-axes [m] of the ellipse with the second moments of the particles: <x^2> = a^2/4.
Eigen::Vector2d semi_axes(const SceneRun& run) {
  const fluid::Snapshot s = run.solver().snapshot();
  Eigen::Array2d first = Eigen::Array2d::Zero(), second = Eigen::Array2d::Zero();
  double mass = 0;
  for (std::size_t i = 0; i < s.density.size(); ++i) {
    const Eigen::Array2d x(s.position[3 * i], s.position[3 * i + 1]);
    mass += run.masses()[i];
    first += run.masses()[i] * x;
    second += run.masses()[i] * x.square();
  }
  return 2 * (second / mass - (first / mass).square()).sqrt();
}

// The semi-axes over those at the start: the lattice's disc is not quite one.
Outcome run(int resolution, const std::vector<std::string>& overrides, int threads) {
  SceneRun run(case_file("elliptical_drop/elliptical_drop.scene"), with_spacing(1.0 / resolution, overrides),
               threads);
  const Eigen::Vector2d before = semi_axes(run);
  const double energy = run.solver().diagnostics().kinetic;
  while (run.next_step()) continue;
  const Eigen::Vector2d stretch = semi_axes(run).cwiseQuotient(before);
  const Ellipse reference = exact(run.time());
  const double short_error = std::abs(stretch[0] / reference[0] - 1);
  const double long_error = std::abs(stretch[1] / reference[1] - 1);
  const double energy_lost = 1 - run.solver().diagnostics().kinetic / energy;
  return run.outcome({{"shorter semi-axis", "% from exact", 100 * short_error, 0.5},
                      {"longer semi-axis", "% from exact", 100 * long_error, 0.5},
                      {"kinetic energy", "% lost", 100 * energy_lost}},
                     std::max(short_error, long_error));
}

}  // namespace

Case elliptical_drop() {
  return {.name = "elliptical_drop",
          .title = "Elliptical drop, to twice the axis, particles over R",
          .reference = "ellipse of incompressible liquid; Monaghan 1994",
          .resolutions = {12, 25, 50},
          .quick = {10},
          .bound_resolution = 50,
          .run = run};
}

}  // namespace sluice::validation
