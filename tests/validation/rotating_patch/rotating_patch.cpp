#include "validation/rotating_patch/rotating_patch.hpp"

#include <algorithm>
#include <cmath>

#include "validation/support/files.hpp"
#include "validation/support/scene_run.hpp"
#include "validation/support/wetted_area.hpp"

namespace sluice::validation {
namespace {

double area(const SceneRun& run) {
  const fluid::Snapshot s = run.solver().snapshot();
  std::vector<double> volume = run.masses();
  for (std::size_t i = 0; i < volume.size(); ++i) volume[i] /= s.density[i];
  return wetted_area(s.position, volume, run.scene().spacing());
}

Outcome run(int resolution, const std::vector<std::string>& overrides, int threads) {
  SceneRun run(case_file("rotating_patch/rotating_patch.scene"), with_spacing(1.0 / resolution, overrides),
               threads);
  const double area_before = area(run);
  const fluid::Diagnostics before = run.solver().diagnostics();
  double momentum_error = 0;
  while (run.next_output()) {
    const double momentum = run.solver().diagnostics().angular_momentum.z();
    momentum_error = std::max(momentum_error, std::abs(momentum / before.angular_momentum.z() - 1));
  }
  const double area_error = std::abs(area(run) / area_before - 1);
  const double energy_lost = 1 - run.solver().diagnostics().kinetic / before.kinetic;
  return run.outcome({{"angular momentum", "% changed", 100 * momentum_error, 0.1},
                      {"free-surface area", "% changed", 100 * area_error, 0.5},
                      {"kinetic energy", "% lost", 100 * energy_lost}},
                     area_error);
}

}  // namespace

Case rotating_patch() {
  return {.name = "rotating_patch",
          .title = "Rotating square patch, omega t = 4, particles over L",
          .reference = "conservation; Colagrossi 2005",
          .resolutions = {25, 50, 100},
          .quick = {25},
          .bound_resolution = 100,
          .run = run};
}

}  // namespace sluice::validation
