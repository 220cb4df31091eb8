#include "validation/support/curve.hpp"

#include <algorithm>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace sluice::validation {

double Curve::at(double where) const {
  const auto above = std::upper_bound(x.begin(), x.end() - 1, where);
  const auto k = static_cast<std::size_t>(std::max<std::ptrdiff_t>(1, above - x.begin()));
  return y[k - 1] + (y[k] - y[k - 1]) * (where - x[k - 1]) / (x[k] - x[k - 1]);
}

Curve read_curve(const std::string& file) {
  std::ifstream in(file);
  if (!in) throw std::runtime_error("cannot read " + file);
  Curve curve;
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || line.front() == '#') continue;
    std::istringstream fields(line);
    double x = 0, y = 0;
    char comma = 0;
    if (!(fields >> x >> comma >> y)) throw std::runtime_error(file + ": not two numbers: " + line);
    curve.x.push_back(x);
    curve.y.push_back(y);
  }
  return curve;
}

}  // namespace sluice::validation
