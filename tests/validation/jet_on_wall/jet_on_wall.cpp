#include "validation/jet_on_wall/jet_on_wall.hpp"

#include <cmath>

#include "validation/support/files.hpp"
#include "validation/support/scene_run.hpp"

namespace sluice::validation {
namespace {

// Of the scene: width [m] and speed [m/s] of the jet.
constexpr double kWidth = 0.1, kSpeed = 1;
// The flow is steady from here on [b/U]; the jet ends at 20.
constexpr double kSteady = 6;

// The mean force over the steady part, as the mean over its steps: what acoustic waves do cancels.
Outcome run(int resolution, const std::vector<std::string>& overrides, int threads) {
  SceneRun run(case_file("jet_on_wall/jet_on_wall.scene"), with_spacing(kWidth / resolution, overrides),
               threads, Walls::kForceMeasured);
  double sum = 0, sum_of_squares = 0;
  int count = 0;
  while (run.next_step()) {
    if (run.time() < kSteady * kWidth / kSpeed) continue;
    const double force = -run.solver().wall_wrench().force.y();
    sum += force;
    sum_of_squares += force * force;
    ++count;
  }
  const double mean = sum / count;
  const double reference = run.scene().liquid().density() * kSpeed * kSpeed * kWidth;
  const double error = std::abs(mean / reference - 1);
  const double deviation = std::sqrt(std::max(0.0, sum_of_squares / count - mean * mean));
  return run.outcome({{"mean force", "% from rho U^2 b", 100 * error, 2},
                      {"standard deviation of the force", "% of rho U^2 b", 100 * deviation / reference}},
                     error);
}

}  // namespace

Case jet_on_wall() {
  return {.name = "jet_on_wall",
          .title = "Jet on a wall, mean force from 6 to 16 b/U, particles over b",
          .reference = "F = rho U^2 b",
          .resolutions = {8, 15, 30},
          .quick = {8},
          .bound_resolution = 30,
          .run = run};
}

}  // namespace sluice::validation
