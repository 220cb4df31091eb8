#include "validation/dam_break/dam_break.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "validation/support/budget.hpp"
#include "validation/support/files.hpp"
#include "validation/support/front.hpp"
#include "validation/support/scene_run.hpp"

namespace sluice::validation {
namespace {

// Of the scene: gravity [m/s^2], the column's width a [m].
constexpr double kG = 9.81, kWidth = 0.05715;
// The far wall stands at 5.4 a.
constexpr double kNearWall = 5.2;
// The experiments' clocks start when the gate is pulled; their curves agree with each other from here on.
constexpr double kFirst = 1;

double front(const SceneRun& run) {
  const fluid::Snapshot s = run.solver().snapshot();
  std::vector<double> x;
  for (std::size_t i = 0; i < s.density.size(); ++i) x.push_back(s.position[3 * i]);
  return front_of(std::move(x), run.scene().spacing());
}

struct Scatter {
  double least, most, mean;
};

// Of the experiments that have a front at this T; none when there is only one.
std::optional<Scatter> scatter(double T) {
  std::vector<double> fronts;
  for (const Experiment& experiment : dam_break_experiments())
    if (experiment.front.covers(T)) fronts.push_back(experiment.front.at(T));
  if (fronts.size() < 2) return std::nullopt;
  const auto [least, most] = std::minmax_element(fronts.begin(), fronts.end());
  double sum = 0;
  for (const double z : fronts) sum += z;
  return Scatter{*least, *most, sum / static_cast<double>(fronts.size())};
}

}  // namespace

const std::vector<Experiment>& dam_break_experiments() {
  static const std::vector<Experiment> experiments = [] {
    std::vector<Experiment> all;
    for (const char* name :
         {"martin_moyce_1952_n2eq2_a1.125in", "martin_moyce_1952_n2eq2_a2.25in", "koshizuka_oka_1996_exp"})
      all.push_back({name, read_curve(case_file("dam_break/" + std::string(name) + ".csv"))});
    return all;
  }();
  return experiments;
}

FrontError compare_with_experiments(const Curve& computed) {
  FrontError error;
  double sum = 0;
  int count = 0;
  for (std::size_t k = 0; k < computed.x.size(); ++k) {
    const auto measured = computed.x[k] > kFirst ? scatter(computed.x[k]) : std::nullopt;
    if (!measured) continue;
    const double z = computed.y[k];
    error.ahead = std::max(error.ahead, z / measured->most - 1);
    error.behind = std::max(error.behind, 1 - z / measured->least);
    sum += std::pow(z / measured->mean - 1, 2);
    ++count;
  }
  error.rms = std::sqrt(sum / count);
  return error;
}

DamBreakRun run_dam_break(int resolution, const std::vector<std::string>& overrides, int threads) {
  SceneRun run(shipped_scene("dam_break"), with_spacing(kWidth / resolution, overrides), threads);
  const double to_T = std::sqrt(2 * kG / kWidth);
  EnergyRise rise(run);
  int most_lost = 0;
  Curve fronts{{0.0}, {1.0}}, energies{{0.0}, {1.0}};
  while (run.next_step()) {
    rise.look(run);
    if (!run.is_output()) continue;
    most_lost = std::max(most_lost, lost_below_or_beside(run));
    energies.x.push_back(run.time() * to_T);
    energies.y.push_back(energy(run) / rise.start());
    if (fronts.y.back() > kNearWall) continue;
    fronts.x.push_back(run.time() * to_T);
    fronts.y.push_back(front(run) / kWidth);
  }
  const FrontError error = compare_with_experiments(fronts);
  return {run.outcome({{"front ahead of the experiments", "% at most, T > 1", 100 * error.ahead, 0},
                       {"front behind the experiments", "% at most, T > 1", 100 * error.behind, 0},
                       {"energy", "% risen at most", 100 * rise.most() / rise.start(), 0.01},
                       {"particles lost", "", static_cast<double>(most_lost), 0}},
                      error.rms),
          fronts, energies};
}

Case dam_break() {
  return {.name = "dam_break",
          .title = "Dam break, T = t sqrt(2g/a) to 8, particles over a",
          .reference = "Martin & Moyce 1952; Koshizuka & Oka 1996",
          .resolutions = {20, 40, 80},
          .quick = {20},
          .bound_resolution = 80,
          .run = [](int resolution, const std::vector<std::string>& overrides, int threads) {
            return run_dam_break(resolution, overrides, threads).outcome;
          }};
}

}  // namespace sluice::validation
