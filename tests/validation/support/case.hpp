#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace sluice::validation {

// One number that a case is judged by.
struct Figure {
  std::string name, unit;
  double value = 0;
  // What is stated of it at the case's bound_resolution; not a number when nothing is.
  double bound = std::numeric_limits<double>::quiet_NaN();
  bool at_least = false;  // the bound is the smallest allowed value, otherwise the largest

  [[nodiscard]] bool missed() const { return at_least ? value < bound : value > bound; }
};

// What one run of a case gave.
struct Outcome {
  std::vector<Figure> figures;
  double error = 0;    // the one share that stands for the case where error is set against time
  double seconds = 0;  // wall-clock time of the stepping alone
  std::uint64_t particles = 0, steps = 0;

  // By its name; throws std::out_of_range naming it.
  [[nodiscard]] double figure(const std::string& name) const;
};

// A scene with a reference. `resolution` counts particles over the case's length, which `title` names.
struct Case {
  std::string name, title, reference;
  std::vector<int> resolutions, quick;  // ascending; quick: seconds
  int bound_resolution;
  // Stated of the observed order at bound_resolution, in cases whose error vanishes with the spacing.
  double least_order = std::numeric_limits<double>::quiet_NaN();
  // `overrides` are those of `sluice run --set`.
  std::function<Outcome(int resolution, const std::vector<std::string>& overrides, int threads)> run;
};

// In the order of the tables.
const std::vector<Case>& all_cases();

// Slope of log(error) over log(1/resolution) between two runs.
double observed_order(int coarse, double coarse_error, int fine, double fine_error);

}  // namespace sluice::validation
