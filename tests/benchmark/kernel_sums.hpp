#pragma once

#include <algorithm>
#include <cmath>

namespace sluice::benchmark {

// How far a kernel is from the criteria of J. Perea and J. Cordero, PC (20)-(25), on a lattice of spacing dx:
// the sum M of the weights is one and the sum N of the slopes zero wherever in the lattice one looks, and
// W'(0) = 0.
struct KernelSums {
  double line_M = 0,
         line_N = 0;         // largest |M - 1| and |N| on a line, as printed, the weights normalised on it
  double plane_M = 0;        // largest |sum W dx^2 - 1| on the square lattice
  double plane_N = 0;        // largest |sum grad W dx^3| there
  double slope_at_zero = 0;  // |W'(0)| h/W(0)
};

// Of a kernel of the plane with the interface of fluid::WendlandC2<2>, in units of dx.
template <typename Kernel>
KernelSums kernel_sums_of(const Kernel& kernel) {
  constexpr int kPlaces = 50;      // between two lattice points
  constexpr int kIntegral = 4000;  // intervals over the support, midpoint rule
  const auto weight = [&](double r) { return kernel.value(r * r); };
  const auto slope_over_r = [&](double r2) { return -kernel.value_and_slope(r2).f; };
  const int reach = static_cast<int>(std::ceil(kernel.support())) + 1;

  double integral = 0;
  for (int k = 0; k < kIntegral; ++k)
    integral += 2 * weight(kernel.support() * (k + 0.5) / kIntegral) * kernel.support() / kIntegral;

  KernelSums result;
  for (int a = 0; a <= kPlaces; ++a) {
    const double x = 0.5 * a / kPlaces;
    double M = 0, N = 0;
    for (int s = -reach; s <= reach; ++s) {
      const double r = x - s;
      if (std::abs(r) >= kernel.support()) continue;
      M += weight(std::abs(r)) / integral;
      N += slope_over_r(r * r) * r / integral;
    }
    result.line_M = std::max(result.line_M, std::abs(M - 1));
    result.line_N = std::max(result.line_N, std::abs(N));
    for (int b = 0; b <= a; ++b) {
      const double y = 0.5 * b / kPlaces;
      double sum = 0, sum_x = 0, sum_y = 0;
      for (int s = -reach; s <= reach; ++s)
        for (int t = -reach; t <= reach; ++t) {
          const double r2 = (x - s) * (x - s) + (y - t) * (y - t);
          if (r2 >= kernel.support() * kernel.support()) continue;
          sum += kernel.value(r2);
          sum_x += slope_over_r(r2) * (x - s);
          sum_y += slope_over_r(r2) * (y - t);
        }
      result.plane_M = std::max(result.plane_M, std::abs(sum - 1));
      result.plane_N = std::max(result.plane_N, std::hypot(sum_x, sum_y));
    }
  }
  const double near = 1e-6 * kernel.support();
  result.slope_at_zero = std::abs(weight(near) - weight(0)) / near * kernel.support() / 2 / weight(0);
  return result;
}

}  // namespace sluice::benchmark
