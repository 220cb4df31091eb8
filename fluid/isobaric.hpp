#pragma once

#include <algorithm>
#include <cmath>

#include "fluid/types.hpp"

namespace sluice::fluid {

// Weight alpha of the difference of pressures in PC (14), from P = |p_i - p_j|/max(|p_i|, |p_j|), PC (16), at
// most one. The printed polynomial PC (15) has 2 at P = 0 but rises above it and does not vanish at 1,
// against the conditions stated there; this one meets them, with the same scale delta, and is smooth at P =
// 0:
//   alpha = 2 (1 - P^2) delta^2/(delta^2 + P^2),   beta = 2 - alpha.
inline double isobaric_weight(double P, double delta) {
  const double P2 = std::min(1.0, P * P), delta2 = delta * delta;
  return 2.0 * (1.0 - P2) * delta2 / (delta2 + P2);
}

struct PressurePoint {
  double p;    // [Pa]
  double rho;  // [kg/m^3]
};

// What stands in PC (13)-(14) for the pressure at a pair, seen from i:
//   1/2 [alpha (p_j - p_i) + beta rho_i^2 (p_j/rho_j^2 + p_i/rho_i^2)] rho_j/rho_i,
// so that the force is f_i = V_i sum_j V_j F x_ij of it. Of the print's max{P_i, P_j} the magnitudes are
// taken: pressures may be negative here. Where pressures are nearly equal only their difference acts, which
// is the same from both sides instead of opposite: linear momentum is not conserved (tests report the drift).
inline double isobaric_pressure(const PressurePoint& i, const PressurePoint& j, double delta) {
  const double largest = std::max(std::abs(i.p), std::abs(j.p));
  if (!(largest > 0.0)) return 0.0;
  const double alpha = isobaric_weight(std::abs(i.p - j.p) / largest, delta);
  const double sum = i.rho * i.rho * (j.p / (j.rho * j.rho) + i.p / (i.rho * i.rho));
  return 0.5 * (alpha * (j.p - i.p) + (2.0 - alpha) * sum) * j.rho / i.rho;
}

}  // namespace sluice::fluid
