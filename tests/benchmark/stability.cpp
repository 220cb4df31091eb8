#include "benchmark/stability.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <fstream>

#include "benchmark/report.hpp"
#include "benchmark/selection.hpp"
#include "protocol/error.hpp"

namespace sluice::benchmark {

const std::vector<StabilityCheck>& all_checks() {
  static const std::vector<StabilityCheck> checks{
      {"random_scenes", random_scenes}, {"violent", violent},         {"checkerboard", checkerboard},
      {"lattice_waves", lattice_waves}, {"kernel_sums", kernel_sums}, {"largest_courant", largest_courant},
      {"still_tank", still_tank}};
  return checks;
}

int stability(const StabilityOptions& options) {
  const auto checks = select(all_checks(), options.checks, "case");
  std::ofstream csv;
  if (!options.csv.empty()) csv = open_output(options.csv);
  std::vector<StabilityTable> tables;
  for (const StabilityCheck& check : checks) {
    tables.push_back(check.run(options));
    fmt::print("{}\n", to_text(tables.back()));
    std::fflush(stdout);
  }
  if (csv.is_open()) csv << to_csv(tables) << std::flush;
  const bool missed = std::any_of(tables.begin(), tables.end(),
                                  [](const StabilityTable& table) { return table.any_missed(); });
  return missed ? protocol::kBadInput : protocol::kDone;
}

}  // namespace sluice::benchmark
