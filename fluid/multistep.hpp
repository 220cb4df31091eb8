#pragma once

namespace sluice::fluid {

// The multistep integrator PC (26)-(27) for constant steps, of scalars or vectors, from the accelerations a0
// at the present time, a1 and a2 one and two steps before:
//   u' = u + dt v + dt^2/2 a0 + beta2 dt^2/6 D,   v' = v + dt a0 + beta1 dt/2 D,   D = 2 a0 - 3 a1 + a2.
// Deviation: the print has D = 2 a0 - 2 a1 + a2, which is not zero for a constant acceleration; the one here
// is the sum of the first two backward differences. PC (28) extrapolates the acceleration to the next time,
// where the solver computes it from the forces: it is left out. beta1 = beta2 = 1 is of second order, the
// paper's 0.7586 and 1.101 of first in the velocity (measured in the tests; the O(n^6) of the paper does not
// follow).
template <typename Value>
Value multistep_difference(const Value& a0, const Value& a1, const Value& a2) {
  const Value last = a0 - a1;
  return 2.0 * last - (a1 - a2);
}

// (u' - u)/dt
template <typename Value>
Value multistep_mean_velocity(const Value& v, const Value& a0, const Value& D, double beta2, double dt) {
  return v + (0.5 * dt) * a0 + (beta2 * dt / 6.0) * D;
}

// v'
template <typename Value>
Value multistep_velocity(const Value& v, const Value& a0, const Value& D, double beta1, double dt) {
  return v + dt * a0 + (0.5 * beta1 * dt) * D;
}

}  // namespace sluice::fluid
