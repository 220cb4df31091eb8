#include "validation/perea_wave/perea_wave.hpp"

#include <algorithm>
#include <cmath>

#include "validation/support/budget.hpp"
#include "validation/support/files.hpp"
#include "validation/support/scene_run.hpp"

namespace sluice::validation {
namespace {

// Of the scene: gravity [m/s^2], the wave's length and the depth [m].
constexpr double kG = 9.81, kLength = 0.503632, kDepth = 0.7 * kLength;
constexpr double kWaveNumber = 2 * M_PI / kLength;
// When pictures are taken, and before the crest falls over [s].
constexpr double kPictures[] = {0.1, 0.2, 0.3, 0.4}, kWhole = 0.15;

double linear_speed() {
  return std::sqrt(kG / kWaveNumber * std::tanh(kWaveNumber * kDepth));
}

// The highest particle that is not alone, over the level [m]: the fifth from the top.
double crest(const fluid::Snapshot& s) {
  std::vector<double> height(s.density.size());
  for (std::size_t i = 0; i < height.size(); ++i) height[i] = s.position[3 * i + 1];
  std::nth_element(height.begin(), height.begin() + 4, height.end(), std::greater<>());
  return height[4] - kDepth;
}

int lost(const fluid::Snapshot& s, double spacing) {
  int count = 0;
  for (std::size_t i = 0; i < s.density.size(); ++i) count += s.position[3 * i + 1] < -0.5 * spacing;
  return count;
}

}  // namespace

PereaWaveRun run_perea_wave(int resolution, const std::vector<std::string>& overrides, int threads) {
  SceneRun run(case_file("perea_wave/perea_wave.scene"), with_spacing(kLength / resolution, overrides),
               threads);
  const fluid::Diagnostics start = run.solver().diagnostics();
  // Over that of the level at rest: half of a wave's energy is kinetic.
  const double wave = 2 * start.kinetic;
  EnergyRise rise(run);
  double fastest = 0, height = 0, compression = 0;
  int most_lost = 0;
  PereaWaveRun result;
  while (run.next_output()) {
    const fluid::Diagnostics d = run.solver().diagnostics();
    const fluid::Snapshot state = run.solver().snapshot();
    rise.look(run);
    fastest = std::max(fastest, d.max_speed);
    compression = std::max(compression, d.max_compression);
    if (run.time() < kWhole) height = std::max(height, crest(state));
    most_lost = std::max(most_lost, lost(state, run.scene().spacing()));
    const std::size_t next = result.times.size();
    if (next < std::size(kPictures) && run.time() > kPictures[next] - 1e-9) {
      result.times.push_back(run.time());
      result.states.push_back(state);
    }
  }
  const fluid::Diagnostics end = run.solver().diagnostics();
  const double drift = std::abs(end.momentum.x() / start.momentum.x() - 1);
  result.outcome =
      run.outcome({{"momentum along the tank", "% changed", 100 * drift, 1},
                   {"energy", "% of the wave's risen at most", 100 * rise.most() / wave, 0.1},
                   {"energy left", "% of the wave's", 100 * (1 - (rise.start() - energy(run)) / wave)},
                   {"crest before it falls over", "% of L above the level", 100 * height / kLength},
                   {"fastest particle", "of the linear wave's speed", fastest / linear_speed()},
                   {"density", "% off at most", 100 * compression, 5},
                   {"particles lost", "", static_cast<double>(most_lost), 0}},
                  drift);
  return result;
}

// The paper shows a picture of a crest, and no number. So it is judged by what holds of any wave in a tank
// that is periodic and whose floor is smooth: its momentum stays, its energy falls.
Case perea_wave() {
  return {.name = "perea_wave",
          .title = "A wave that breaks, kA = 0.55, to 1 s, particles over its length",
          .reference = "conservation; Perea & Cordero, section 8",
          .resolutions = {30, 60, 100},
          .quick = {30},
          .bound_resolution = 100,
          .run = [](int resolution, const std::vector<std::string>& overrides, int threads) {
            return run_perea_wave(resolution, overrides, threads).outcome;
          }};
}

}  // namespace sluice::validation
