#include "benchmark/measurement.hpp"

#include <algorithm>
#include <cmath>

namespace sluice::benchmark {

namespace {

bool dominates(const Measurement& a, const Measurement& b) {
  const double error = a.outcome.error, seconds = a.outcome.seconds;
  return error <= b.outcome.error && seconds <= b.outcome.seconds &&
         (error < b.outcome.error || seconds < b.outcome.seconds);
}

void set_order(const validation::Case& what, const Measurement& coarse, Measurement& fine) {
  fine.order = validation::observed_order(coarse.resolution, coarse.outcome.error, fine.resolution,
                                          fine.outcome.error);
  if (!std::isnan(what.least_order))
    fine.outcome.figures.push_back({"observed order", "", *fine.order, what.least_order, true});
}

}  // namespace

bool CaseTable::any_missed(const std::string& formulation) const {
  return std::any_of(rows.begin(), rows.end(), [&](const Measurement& row) {
    if (row.formulation != formulation || !bounded(row)) return false;
    return !row.failure.empty() || std::any_of(row.outcome.figures.begin(), row.outcome.figures.end(),
                                               [](const validation::Figure& f) { return f.missed(); });
  });
}

void rank(CaseTable& table) {
  const Measurement* coarser = nullptr;
  for (Measurement& row : table.rows) {
    if (!row.failure.empty()) continue;
    if (coarser != nullptr && coarser->formulation == row.formulation) set_order(table.what, *coarser, row);
    coarser = &row;
    row.on_front = std::none_of(table.rows.begin(), table.rows.end(), [&](const Measurement& other) {
      return other.failure.empty() && dominates(other, row);
    });
  }
}

}  // namespace sluice::benchmark
