#include "benchmark/measurement.hpp"

#include <algorithm>

namespace sluice::benchmark {

namespace {

bool dominates(const Measurement& a, const Measurement& b) {
  const double error = a.outcome.error, seconds = a.outcome.seconds;
  return error <= b.outcome.error && seconds <= b.outcome.seconds &&
         (error < b.outcome.error || seconds < b.outcome.seconds);
}

}  // namespace

bool CaseTable::any_missed(const std::string& formulation) const {
  return std::any_of(rows.begin(), rows.end(), [&](const Measurement& row) {
    if (row.formulation != formulation || !bounded(row)) return false;
    return !row.failure.empty() || std::any_of(row.outcome.figures.begin(), row.outcome.figures.end(),
                                               [](const validation::Figure& f) { return f.missed(); });
  });
}

void rank(std::vector<Measurement>& rows) {
  const Measurement* coarser = nullptr;
  for (Measurement& row : rows) {
    if (!row.failure.empty()) continue;
    if (coarser != nullptr && coarser->formulation == row.formulation)
      row.order = validation::observed_order(coarser->resolution, coarser->outcome.error, row.resolution,
                                             row.outcome.error);
    coarser = &row;
    row.on_front = std::none_of(rows.begin(), rows.end(), [&](const Measurement& other) {
      return other.failure.empty() && dominates(other, row);
    });
  }
}

}  // namespace sluice::benchmark
