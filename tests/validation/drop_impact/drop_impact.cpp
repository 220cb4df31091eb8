#include "validation/drop_impact/drop_impact.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "validation/support/budget.hpp"
#include "validation/support/files.hpp"
#include "validation/support/scene_run.hpp"

namespace sluice::validation {
namespace {

// Of the scene [m].
constexpr double kDiameter = 0.01, kLength = 0.1;

// The exact flow is its own mirror image. Water that stands on one side and not on the other, by bins of a
// tenth of the drop, over the drop's mass.
double asymmetry(const SceneRun& run) {
  constexpr std::size_t kBins = 100;
  const fluid::Snapshot s = run.solver().snapshot();
  std::array<double, kBins> mass{};
  for (std::size_t i = 0; i < s.density.size(); ++i) {
    const auto bin = static_cast<std::size_t>(std::max(0.0, s.position[3 * i] / kLength * kBins));
    mass[std::min(bin, kBins - 1)] += run.masses()[i];
  }
  double difference = 0;
  for (std::size_t bin = 0; bin < kBins / 2; ++bin) difference += std::abs(mass[bin] - mass[kBins - 1 - bin]);
  const double drop = run.scene().liquid().density() * M_PI / 4 * kDiameter * kDiameter;
  return difference / drop;
}

// Volume of all particles over that at the start, less one.
double volume_change(const SceneRun& run, const std::vector<double>& density_at_start) {
  const fluid::Snapshot s = run.solver().snapshot();
  double before = 0, now = 0;
  for (std::size_t i = 0; i < s.density.size(); ++i) {
    before += run.masses()[i] / density_at_start[i];
    now += run.masses()[i] / s.density[i];
  }
  return now / before - 1;
}

Outcome run(int resolution, const std::vector<std::string>& overrides, int threads) {
  SceneRun run(case_file("drop_impact/drop_impact.scene"), with_spacing(kDiameter / resolution, overrides),
               threads);
  const std::vector<double> density = run.solver().snapshot().density;
  EnergyRise rise(run);
  double largest_asymmetry = 0, largest_change = 0;
  while (run.next_step()) {
    rise.look(run);
    if (!run.is_output()) continue;
    largest_asymmetry = std::max(largest_asymmetry, asymmetry(run));
    largest_change = std::max(largest_change, std::abs(volume_change(run, density)));
  }
  return run.outcome({{"asymmetry", "% of the drop's mass, at most", 100 * largest_asymmetry},
                      {"volume", "% changed at most", 100 * largest_change},
                      {"energy", "% risen at most", 100 * rise.most() / rise.start()}},
                     largest_asymmetry);
}

}  // namespace

Case drop_impact() {
  return {.name = "drop_impact",
          .title = "Drop impact at 2 m/s, particles over D",
          .reference = "mirror symmetry; Cueto-Felgueroso et al., section 7.2",
          .resolutions = {5, 10, 20},
          .quick = {5},
          .bound_resolution = 20,
          .run = run};
}

}  // namespace sluice::validation
