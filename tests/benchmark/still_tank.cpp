#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "benchmark/checks.hpp"
#include "validation/support/files.hpp"
#include "validation/support/scene_run.hpp"

namespace sluice::benchmark {

StabilityTable still_tank(const StabilityOptions& options) {
  constexpr double kG = 9.81, kDepth = 1;  // of the scene
  constexpr int kResolution = 20;
  const double length = options.quick ? 20 : 200;  // t sqrt(g/H)
  const double duration = length * std::sqrt(kDepth / kG);
  validation::SceneRun run(
      validation::case_file("hydrostatic_column/hydrostatic_column.scene"),
      {fmt::format("spacing={}", kDepth / kResolution), fmt::format("duration={}", duration)});
  StabilityTable table{
      .name = "still_tank",
      .title = fmt::format("A tank at rest, H/{}, to t sqrt(g/H) = {:g}", kResolution, length),
      .items = "share of the time",
      .columns = {{"largest kinetic/potential", ""}},
      .rows = {},
      .figures = {}};
  constexpr int kParts = 5;
  std::vector<double> largest(kParts, 0);
  while (run.next_output()) {
    const fluid::Diagnostics d = run.solver().diagnostics();
    const int part = std::min(kParts - 1, static_cast<int>(kParts * run.time() / duration));
    largest[part] = std::max(largest[part], d.kinetic / d.potential);
  }
  for (int part = 0; part < kParts; ++part)
    table.rows.push_back(
        {fmt::format("{} to {} %", 100 * part / kParts, 100 * (part + 1) / kParts), {largest[part]}, ""});
  table.figures = {{"kinetic/potential in the last fifth", "", largest.back(), 1e-6},
                   {"the last fifth over the first", "", largest.back() / largest.front(), 1}};
  return table;
}

}  // namespace sluice::benchmark
