#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>

#include "benchmark/checks.hpp"
#include "benchmark/follow.hpp"
#include "benchmark/random_scene.hpp"

namespace sluice::benchmark {

namespace {

Faults follow_seed(std::uint64_t seed, const std::string& directory) {
  const Scene scene = random_scene(seed);
  if (!directory.empty()) write_scene(scene, seed, directory);
  validation::SceneRun run(scene);
  const Faults faults = follow(run);
  spdlog::info("seed {}: {} particles, {} steps: {}", seed, faults.particles, faults.steps,
               faults.any() ? faults.text() : fmt::format("sound, rise {:.1e}", faults.energy_rise));
  return faults;
}

}  // namespace

StabilityTable random_scenes(const StabilityOptions& options) {
  constexpr std::uint64_t kQuickScenes = 5;
  const std::uint64_t count = options.quick ? std::min(options.scenes, kQuickScenes) : options.scenes;
  StabilityTable table{.name = "random_scenes",
                       .title = fmt::format("Random scenes at the defaults, seeds {} to {}",
                                            options.first_seed, options.first_seed + count - 1),
                       .items = "seed that fails",
                       .columns = {{"rise", "%"}, {"lost", ""}, {"particles", ""}, {"ends at", "s"}},
                       .rows = {},
                       .figures = {}};
  double unsound = 0, losing = 0, rising = 0, largest = 0;
  for (std::uint64_t seed = options.first_seed; seed < options.first_seed + count; ++seed) {
    const Faults faults = follow_seed(seed, options.write);
    unsound += !faults.stop.empty();
    losing += faults.lost > 0;
    rising += faults.energy_rise > Faults::kMostRise;
    largest = std::max(largest, faults.energy_rise);
    if (faults.any())
      table.rows.push_back({fmt::format("{}", seed),
                            {100 * faults.energy_rise, static_cast<double>(faults.lost),
                             static_cast<double>(faults.particles), faults.end},
                            faults.text()});
  }
  table.figures = {{"scenes", "", static_cast<double>(count)},
                   {"scenes with a state that cannot be", "", unsound, 0},
                   {"scenes that lose a particle", "", losing, 0},
                   {"scenes whose energy rises by more than 1 %", "", rising, 0},
                   {"largest rise of energy", "%", 100 * largest}};
  return table;
}

}  // namespace sluice::benchmark
