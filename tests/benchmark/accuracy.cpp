#include "benchmark/accuracy.hpp"

#include <fmt/core.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <fstream>

#include "benchmark/formulations.hpp"
#include "benchmark/plot.hpp"
#include "benchmark/report.hpp"
#include "benchmark/selection.hpp"
#include "protocol/error.hpp"
#include "protocol/scene_file.hpp"

namespace sluice::benchmark {

namespace {

using validation::Case;

// A run that fails is a result: the others go on.
Measurement measure(const Case& what, const Formulation& formulation, int resolution, int threads) {
  Measurement row{
      .formulation = formulation.name, .resolution = resolution, .outcome = {}, .failure = {}, .order = {}};
  try {
    row.outcome = what.run(resolution, formulation.overrides, threads);
  } catch (const std::exception& error) {
    row.failure = error.what();
  }
  spdlog::info("{} {} {}: {}", what.name, formulation.name, resolution,
               row.failure.empty() ? fmt::format("{:.1f} s", row.outcome.seconds) : row.failure);
  return row;
}

std::vector<int> resolutions(const Case& what, const AccuracyOptions& options) {
  if (options.quick) return what.quick;
  if (options.resolutions.empty()) return what.resolutions;
  std::vector<int> ascending = options.resolutions;
  std::sort(ascending.begin(), ascending.end());
  return ascending;
}

CaseTable measure_all(const Case& what, const std::vector<Formulation>& formulations,
                      const AccuracyOptions& options) {
  CaseTable table{what, {}};
  for (const Formulation& formulation : formulations)
    for (const int resolution : resolutions(what, options))
      table.rows.push_back(measure(what, formulation, resolution, options.threads));
  rank(table);
  return table;
}

}  // namespace

int accuracy(const AccuracyOptions& options) {
  const auto cases = select(validation::all_cases(), options.cases, "case");
  const auto formulations = options.formulations.empty()
                                ? std::vector{all_formulations().front()}
                                : select(all_formulations(), options.formulations, "formulation");
  std::ofstream csv;
  if (!options.csv.empty()) csv = open_output(options.csv);
  if (!options.plot.empty()) open_output(options.plot);

  std::vector<CaseTable> tables;
  for (const Case& what : cases) {
    tables.push_back(measure_all(what, formulations, options));
    fmt::print("{}\n", to_text(tables.back()));
    std::fflush(stdout);
  }
  const std::string text = to_csv(tables);
  if (csv.is_open()) csv << text << std::flush;
  if (!options.plot.empty()) plot("plot_accuracy.py", text, options.plot);
  const bool missed = std::any_of(tables.begin(), tables.end(), [](const CaseTable& table) {
    return table.any_missed(all_formulations().front().name);
  });
  return missed ? protocol::kBadInput : protocol::kDone;
}

}  // namespace sluice::benchmark
