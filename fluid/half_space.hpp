#pragma once

#include <algorithm>
#include <functional>
#include <numbers>
#include <vector>

#include "fluid/types.hpp"

namespace sluice::fluid {

// A support that liquid with a plane surface fills in part: its share m0 follows from how far the centre of
// what is filled lies off the particle, |m1|/(m0 h). Tabulated for a radial kernel, the surface moved through
// the support.
// On a lattice the outermost row has 3.5 % more than its share, the next 0.7 %. A table fitted to that row
// holds worse: the stirred tank of README.md, "Crowding", overturned at t sqrt(g/H) = 100.
template <int Dim>
class HalfSpace {
 public:
  template <typename Kernel>
  HalfSpace(const Kernel& kernel, double h) {
    const double reach = kernel.support(), thickness = 2.0 * reach / kSlices;
    double m0 = 0, m1 = 0;
    for (int k = 0; k < kSlices; ++k) {
      const double y = -reach + (k + 0.5) * thickness;
      const double slice = plane_integral(kernel, y) * thickness;
      m0 += slice;
      m1 += slice * y;
      if (m0 < kLeastShare) continue;
      offset_.push_back(-m1 / (m0 * h));
      share_.push_back(m0);
    }
    for (double& share : share_) share /= m0;
  }

  // The share [-] at an offset |m1|/(m0 h) [-].
  [[nodiscard]] double share(double offset) const {
    if (offset <= offset_.back()) return 1.0;
    if (offset >= offset_.front()) return share_.front();
    const auto at = std::lower_bound(offset_.begin(), offset_.end(), offset, std::greater<>());
    const auto k = static_cast<std::size_t>(at - offset_.begin());
    const double t = (offset - offset_[k]) / (offset_[k - 1] - offset_[k]);
    return share_[k] + t * (share_[k - 1] - share_[k]);
  }

 private:
  static constexpr int kSlices = 400;
  static constexpr double kLeastShare = 0.02;  // less is no half space: a particle is 0.1 of its own support

  // Integral [1/m] of the kernel over the plane at the distance y.
  template <typename Kernel>
  static double plane_integral(const Kernel& kernel, double y) {
    const double step = kernel.support() / kSlices;
    double sum = 0;
    for (int k = 0; k < kSlices; ++k) {
      const double s = (k + 0.5) * step;
      Vec<Dim> x = Vec<Dim>::Zero();
      x[0] = s;
      x[1] = y;
      sum += kernel.value(x) * (Dim == 2 ? 2.0 : 2.0 * std::numbers::pi * s) * step;
    }
    return sum;
  }

  std::vector<double> offset_, share_;  // the offset falls, the share rises
};

}  // namespace sluice::fluid
