#pragma once

#include "validation/support/curve.hpp"

namespace sluice::validation {

// y(t) = exp(-decay t) (cosine cos(frequency t) + sine sin(frequency t)) + offset
struct Oscillation {
  double frequency = 0;  // [rad/s]
  double decay = 0;      // [1/s]
  double cosine = 0, sine = 0, offset = 0;
};

// Least squares by Gauss-Newton steps from a start near the answer. Throws std::runtime_error when they do
// not converge.
Oscillation fit_oscillation(const Curve& curve, const Oscillation& start);

}  // namespace sluice::validation
