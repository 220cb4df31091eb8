#include "validation/two_liquid_dam_break/two_liquid_dam_break.hpp"

#include <algorithm>
#include <cmath>

#include "validation/dam_break/dam_break.hpp"
#include "validation/support/budget.hpp"
#include "validation/support/files.hpp"
#include "validation/support/front.hpp"
#include "validation/support/scene_run.hpp"

namespace sluice::validation {
namespace {

// Of the scene: gravity [m/s^2], the columns' width a and the tank's length [m].
constexpr double kG = 9.81, kWidth = 0.1, kLength = 0.9;
// The heavy liquid is number 0 and stands on the right.
constexpr std::uint8_t kHeavy = 0;

// From the end wall [m].
double front(const SceneRun& run, std::uint8_t liquid) {
  const fluid::Snapshot s = run.solver().snapshot();
  std::vector<double> way;
  for (std::size_t i = 0; i < s.density.size(); ++i)
    if (s.liquid[i] == liquid) {
      const double x = s.position[3 * i];
      way.push_back(liquid == kHeavy ? kLength - x : x);
    }
  return front_of(std::move(way), run.scene().spacing());
}

// Height of the liquid's centre of mass [m].
double height(const SceneRun& run, std::uint8_t liquid) {
  const fluid::Snapshot s = run.solver().snapshot();
  double mass = 0, moment = 0;
  for (std::size_t i = 0; i < s.density.size(); ++i) {
    if (s.liquid[i] != liquid) continue;
    mass += run.masses()[i];
    moment += run.masses()[i] * s.position[3 * i + 1];
  }
  return moment / mass;
}

// Largest difference of the fronts over their mean, for T > 1.
double difference(const Curve& light, const Curve& heavy) {
  double largest = 0;
  for (std::size_t k = 0; k < light.x.size(); ++k)
    if (light.x[k] > 1)
      largest = std::max(largest, 2 * std::abs(light.y[k] - heavy.y[k]) / (light.y[k] + heavy.y[k]));
  return largest;
}

}  // namespace

TwoLiquidDamBreakRun run_two_liquid_dam_break(int resolution, const std::vector<std::string>& overrides,
                                              int threads) {
  SceneRun run(shipped_scene("two_liquid_dam_break"), with_spacing(kWidth / resolution, overrides), threads);
  const double to_T = std::sqrt(2 * kG / kWidth);
  EnergyRise rise(run);
  int most_lost = 0;
  bool apart = true;
  Curve light{{0.0}, {1.0}}, heavy = light, energies = light;
  while (run.next_step()) {
    rise.look(run);
    if (!run.is_output()) continue;
    most_lost = std::max(most_lost, lost_below_or_beside(run));
    energies.x.push_back(run.time() * to_T);
    energies.y.push_back(energy(run) / rise.start());
    const double of_light = front(run, 1), of_heavy = front(run, kHeavy);
    apart = apart && of_light + of_heavy < kLength - 2 * run.scene().spacing();
    if (!apart) continue;
    light.x.push_back(run.time() * to_T);
    heavy.x.push_back(run.time() * to_T);
    light.y.push_back(of_light / kWidth);
    heavy.y.push_back(of_heavy / kWidth);
  }
  const FrontError of_light = compare_with_experiments(light), of_heavy = compare_with_experiments(heavy);
  const double error = std::max(of_light.rms, of_heavy.rms);
  return {run.outcome(
              {{"light front from the experiments", "% rms, T > 1", 100 * of_light.rms, 15},
               {"heavy front from the experiments", "% rms, T > 1", 100 * of_heavy.rms, 15},
               {"fronts apart", "% at most, T > 1", 100 * difference(light, heavy), 5},
               {"light above heavy at the end", "% of a", 100 * (height(run, 1) - height(run, 0)) / kWidth},
               {"energy", "% risen at most", 100 * rise.most() / rise.start(), 0.01},
               {"particles lost", "", static_cast<double>(most_lost), 0}},
              error),
          light, heavy, energies};
}

// Until they meet, the columns fall alike: density drops out of the equations of a liquid with a free
// surface, and what the viscosities of the paper differ by is little. So either front is that of the
// experiments with water.
Case two_liquid_dam_break() {
  return {.name = "two_liquid_dam_break",
          .title = "Two dams of liquids of 2:1 break, to 0.95 s, particles over a",
          .reference = "Martin & Moyce 1952; Koshizuka & Oka 1996; Cueto-Felgueroso et al., section 7.1",
          .resolutions = {5, 10, 20},
          .quick = {10},
          .bound_resolution = 20,
          .run = [](int resolution, const std::vector<std::string>& overrides, int threads) {
            return run_two_liquid_dam_break(resolution, overrides, threads).outcome;
          }};
}

}  // namespace sluice::validation
