#pragma once

#include <optional>
#include <string>
#include <vector>

#include "validation/support/case.hpp"

namespace sluice::benchmark {

// One case run with one formulation at one resolution.
struct Measurement {
  std::string formulation;
  int resolution = 0;
  validation::Outcome outcome;
  std::string failure;          // why there is no outcome; empty when there is one
  std::optional<double> order;  // between the next coarser resolution of the formulation and this one
  bool on_front = false;        // no other run of the case is both more accurate and faster
};

// All measurements of one case.
struct CaseTable {
  validation::Case what;
  std::vector<Measurement> rows;

  // Whether a figure misses what is stated of it: bounds hold from the case's bound_resolution on.
  [[nodiscard]] bool bounded(const Measurement& row) const { return row.resolution >= what.bound_resolution; }
  [[nodiscard]] bool missed(const Measurement& row, const validation::Figure& figure) const {
    return bounded(row) && figure.missed();
  }
  [[nodiscard]] bool any_missed(const std::string& formulation) const;
};

// Fills in `order` and `on_front`; where an order is stated it becomes a figure. Precondition: the
// resolutions of a formulation ascend.
void rank(CaseTable& table);

}  // namespace sluice::benchmark
