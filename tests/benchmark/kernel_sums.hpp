#pragma once

#include <algorithm>
#include <cmath>

#include "fluid/types.hpp"

namespace sluice::benchmark {

// How far a kernel is from the criteria of J. Perea and J. Cordero, PC (20)-(25), on a lattice of spacing dx:
// the sum M of the weights is one and the sum N of the slopes zero wherever in the lattice one looks, and
// W'(0) = 0.
struct KernelSums {
  double line_M = 0,
         line_N = 0;         // largest |M - 1| and |N| on a line, as printed, the weights normalised on it
  double plane_M = 0;        // largest |sum W dx^2 - 1| on the square lattice
  double plane_N = 0;        // largest |sum grad W dx^3| there
  double slope_at_zero = 0;  // |W'(0)|/W(0)
};

namespace kernel_detail {

constexpr double kStep =
    1e-5;  // of the central differences [dx]; what a solver calls slope is not always the gradient

template <typename Kernel>
double slope(const Kernel& kernel, const fluid::Vec<2>& x, int axis) {
  const fluid::Vec<2> step = kStep * fluid::Vec<2>::Unit(axis);
  return (kernel.value(fluid::Vec<2>(x + step)) - kernel.value(fluid::Vec<2>(x - step))) / (2 * kStep);
}

// Of W along an axis; the line on which a sum of weights is one.
template <typename Kernel>
double integral(const Kernel& kernel) {
  constexpr int kIntervals = 4000;  // over the support, midpoint rule
  const double width = kernel.support() / kIntervals;
  double sum = 0;
  for (int k = 0; k < kIntervals; ++k) sum += 2 * width * kernel.value(fluid::Vec<2>((k + 0.5) * width, 0));
  return sum;
}

}  // namespace kernel_detail

// Of a kernel of the plane (fluid/kernel.hpp), in units of dx, looked at from 51 places between two lattice
// points along each axis.
template <typename Kernel>
KernelSums kernel_sums_of(const Kernel& kernel) {
  constexpr int kPlaces = 50;
  const int reach = static_cast<int>(std::ceil(kernel.support())) + 1;
  const double line = kernel_detail::integral(kernel);
  KernelSums result;
  for (int a = 0; a <= kPlaces; ++a) {
    double line_M = 0, line_N = 0;
    for (int s = -reach; s <= reach; ++s) {
      const fluid::Vec<2> x(0.5 * a / kPlaces - s, 0);
      line_M += kernel.value(x) / line;
      line_N += kernel_detail::slope(kernel, x, 0) / line;
    }
    result.line_M = std::max(result.line_M, std::abs(line_M - 1));
    result.line_N = std::max(result.line_N, std::abs(line_N));
    for (int b = 0; b <= a; ++b) {
      double M = 0;
      fluid::Vec<2> N = fluid::Vec<2>::Zero();
      for (int s = -reach; s <= reach; ++s)
        for (int t = -reach; t <= reach; ++t) {
          const fluid::Vec<2> x(0.5 * a / kPlaces - s, 0.5 * b / kPlaces - t);
          M += kernel.value(x);
          for (int axis = 0; axis < 2; ++axis) N[axis] += kernel_detail::slope(kernel, x, axis);
        }
      result.plane_M = std::max(result.plane_M, std::abs(M - 1));
      result.plane_N = std::max(result.plane_N, N.norm());
    }
  }
  // One-sided: the central difference of an even function vanishes.
  const double at_zero = kernel.value(fluid::Vec<2>(0, 0));
  const double beside = kernel.value(fluid::Vec<2>(kernel_detail::kStep, 0));
  result.slope_at_zero = std::abs(beside - at_zero) / kernel_detail::kStep / at_zero;
  return result;
}

}  // namespace sluice::benchmark
