#include <fmt/format.h>

#include <algorithm>

#include "benchmark/checks.hpp"
#include "benchmark/follow.hpp"
#include "validation/support/files.hpp"

namespace sluice::benchmark {

namespace {

struct Example {
  std::string name;
  std::filesystem::path scene;
  std::vector<std::string> overrides;
};

std::vector<Example> examples() {
  using validation::case_file;
  return {{"still tank, H/20, t sqrt(g/H) = 20",
           case_file("hydrostatic_column/hydrostatic_column.scene"),
           {"spacing=0.05", "duration=6.386"}},
          {"dam break, a/20", validation::shipped_scene("dam_break"), {"spacing=0.0028575"}},
          {"rotating patch, L/25, omega t = 2",
           case_file("rotating_patch/rotating_patch.scene"),
           {"spacing=0.04", "duration=2"}}};
}

bool sound(const Example& example, double courant) {
  auto overrides = example.overrides;
  overrides.push_back(fmt::format("formulation.courant={:g}", courant));
  validation::SceneRun run(example.scene, overrides);
  return !follow(run).any();
}

// To this many digits, and no further than a scene may ask for; 0 when not even the least is.
double largest(const Example& example, double width) {
  double good = 0.1, bad = 1;
  if (sound(example, bad)) return bad;
  if (!sound(example, good)) return 0;
  while (bad - good > width) {
    const double middle = (good + bad) / 2;
    (sound(example, middle) ? good : bad) = middle;
  }
  return good;
}

}  // namespace

StabilityTable largest_courant(const StabilityOptions& options) {
  const double width = options.quick ? 0.15 : 0.02;
  StabilityTable table{
      .name = "largest_courant",
      .title = fmt::format("Largest Courant number of a sound run, to {:g}; 1 is the most allowed", width),
      .items = "scene",
      .columns = {{"Courant number", ""}},
      .rows = {},
      .figures = {}};
  double least = 1;
  for (const Example& example : examples()) {
    const double found = largest(example, width);
    table.rows.push_back({example.name, {found}, ""});
    least = std::min(least, found);
  }
  table.figures = {{"least of them, over the default", "", least / fluid::Formulation{}.courant, 1, true}};
  return table;
}

}  // namespace sluice::benchmark
