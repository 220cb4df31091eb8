#include "validation/support/case.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace sluice::validation {

double Outcome::figure(const std::string& name) const {
  const auto found =
      std::find_if(figures.begin(), figures.end(), [&](const Figure& f) { return f.name == name; });
  if (found == figures.end()) throw std::out_of_range("no figure is named " + name);
  return found->value;
}

double observed_order(int coarse, double coarse_error, int fine, double fine_error) {
  return std::log(coarse_error / fine_error) / std::log(static_cast<double>(fine) / coarse);
}

}  // namespace sluice::validation
