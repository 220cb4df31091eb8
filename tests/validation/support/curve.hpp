#pragma once

#include <string>
#include <vector>

namespace sluice::validation {

// A measured or computed curve y(x), x rising.
struct Curve {
  std::vector<double> x, y;

  // Linear in between; precondition: x within the curve's range.
  [[nodiscard]] double at(double where) const;
  [[nodiscard]] bool covers(double where) const { return where >= x.front() && where <= x.back(); }
};

// Two columns of a CSV file; lines that start with '#' are comments. Throws std::runtime_error.
Curve read_curve(const std::string& file);

}  // namespace sluice::validation
