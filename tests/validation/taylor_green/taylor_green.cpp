#include "validation/taylor_green/taylor_green.hpp"

#include <algorithm>
#include <cmath>

#include "validation/support/files.hpp"
#include "validation/support/scene_run.hpp"

namespace sluice::validation {
namespace {

constexpr double kViscosity = 0.01;  // nu of the scene [m^2/s]; its length [m] and speed [m/s] are 1
constexpr double kWaveNumber = 2 * M_PI;

// Share of the velocity that is left.
double left(double time) {
  return std::exp(-2 * kViscosity * kWaveNumber * kWaveNumber * time);
}

// Root mean square over the particles of their velocity less the exact one, over the speed at this time.
double velocity_error(const SceneRun& run) {
  const fluid::Snapshot s = run.solver().snapshot();
  const double speed = left(run.time());
  double sum = 0;
  for (std::size_t i = 0; i < s.density.size(); ++i) {
    const double x = kWaveNumber * s.position[3 * i], y = kWaveNumber * s.position[3 * i + 1];
    sum += std::pow(s.velocity[3 * i] - speed * std::sin(x) * std::cos(y), 2) +
           std::pow(s.velocity[3 * i + 1] + speed * std::cos(x) * std::sin(y), 2);
  }
  return std::sqrt(sum / static_cast<double>(s.density.size())) / speed;
}

Outcome run(int resolution, const std::vector<std::string>& overrides, int threads) {
  SceneRun run(case_file("taylor_green/taylor_green.scene"), with_spacing(1.0 / resolution, overrides),
               threads);
  const double start = run.solver().diagnostics().kinetic;
  double largest_error = 0;
  while (run.next_output()) {
    const double exact = std::pow(left(run.time()), 2);
    largest_error = std::max(largest_error, std::abs(run.solver().diagnostics().kinetic / start / exact - 1));
  }
  const double exact = std::pow(left(run.time()), 2);
  const double end_error = std::abs(run.solver().diagnostics().kinetic / start / exact - 1);
  const double error = velocity_error(run);
  return run.outcome({{"kinetic energy at the end", "% from theory", 100 * end_error, 2},
                      {"kinetic energy at any time", "% from theory", 100 * largest_error},
                      {"velocity at the end", "% rms of the exact speed", 100 * error}},
                     error);
}

}  // namespace

Case taylor_green() {
  return {.name = "taylor_green",
          .title = "Taylor-Green vortices at Re 100, t = 1 L/U, particles over L",
          .reference = "Taylor & Green 1937",
          .resolutions = {25, 50, 100},
          .quick = {20},
          .bound_resolution = 100,
          .least_order = 1.8,
          .run = run};
}

}  // namespace sluice::validation
