#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>

#include "benchmark/checks.hpp"
#include "benchmark/follow.hpp"
#include "benchmark/violent_scenes.hpp"
#include "fluid/setup.hpp"

namespace sluice::benchmark {

namespace {

// What one floor makes of the scenes of one dimension.
struct Findings {
  double scenes = 0, sound = 0, ended = 0;
  double compression = 0, rise = 0;  // the largest
};

Findings follow_all(int dimension, double floor, bool quick) {
  Findings findings;
  for (ViolentScene& violent : violent_scenes(dimension, quick)) {
    violent.scene.mutable_formulation()->set_moment_floor(floor);
    validation::SceneRun run(violent.scene);
    const Faults faults = follow(run);
    spdlog::info("floor {:g}, {}D {}: {} particles, {} steps, compression {:.1f} %: {}", floor, dimension,
                 violent.name, faults.particles, faults.steps, 100 * faults.compression,
                 faults.any() ? faults.text() : fmt::format("sound, rise {:.1e}", faults.energy_rise));
    ++findings.scenes;
    findings.sound += !faults.any();
    findings.ended += !faults.stop.empty();
    findings.compression = std::max(findings.compression, faults.compression);
    findings.rise = std::max(findings.rise, faults.energy_rise);
  }
  return findings;
}

}  // namespace

StabilityTable violent(const StabilityOptions& options) {
  const double chosen = fluid::Formulation{}.moment_floor;
  const std::vector<double> floors =
      options.quick ? std::vector{chosen} : std::vector{0.05, 0.1, chosen, 0.3, 0.45, 0.6};
  StabilityTable table{.name = "violent",
                       .title = "Impacts and splashes over the floor of the moments' eigenvalues",
                       .items = "floor",
                       .columns = {{"scenes", ""},
                                   {"sound", ""},
                                   {"stopped", ""},
                                   {"largest compression", "%"},
                                   {"largest rise", "%"}},
                       .rows = {},
                       .figures = {}};
  for (const double floor : floors)
    for (const int dimension : {2, 3}) {
      const Findings found = follow_all(dimension, floor, options.quick);
      table.rows.push_back(
          {fmt::format("{:g}, {}D", floor, dimension),
           {found.scenes, found.sound, found.ended, 100 * found.compression, 100 * found.rise},
           ""});
      if (floor == chosen)
        table.figures.push_back({fmt::format("{}D scenes that are not sound at the default", dimension), "",
                                 found.scenes - found.sound, 0});
    }
  return table;
}

}  // namespace sluice::benchmark
