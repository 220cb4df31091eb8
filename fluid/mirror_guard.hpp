#pragma once

#include <algorithm>
#include <vector>

#include "fluid/boundary.hpp"
#include "fluid/model.hpp"
#include "fluid/parallel.hpp"
#include "fluid/particles.hpp"

namespace sluice::fluid {

// The penetration guard of force_sweep.hpp at mirrored sides: a particle and its image do not repel each
// other when they are close, so films thinner than a spacing would slide through the mirror. A spring holds
// particles off from a quarter of a spacing on, where the one to a boundary particle half a spacing behind
// the side would begin.
template <int Dim>
class MirrorGuard {
 public:
  template <typename Kernel>
  MirrorGuard(const Mirrors& mirrors, const Model<Dim, Kernel>& model)
      : range_(model.guard_range - 0.5 * model.spacing), stiffness_(model.guard_stiffness) {
    for (int a = 0; a < Dim; ++a) {
      const auto side = static_cast<std::size_t>(2 * a);
      if (mirrors.at[side]) planes_.push_back({Vec<Dim>::Unit(a), mirrors.lower[a]});
      if (mirrors.at[side + 1]) planes_.push_back({-Vec<Dim>::Unit(a), -mirrors.upper[a]});
    }
  }

  void accelerate(const Parallel& parallel, Particles<Dim>& fluid) const {
    for (const Plane<Dim>& plane : planes_)
      parallel.for_each(fluid.size(), [&](std::size_t i) {
        const double stretch = range_ - plane.distance(fluid.node[i].x);
        if (stretch > 0.0) fluid.acceleration[i] += stiffness_ * stretch / fluid.mass[i] * plane.normal;
      });
  }

  // Energy [J] stored in the springs.
  [[nodiscard]] double energy(const Particles<Dim>& fluid) const {
    double sum = 0;
    for (const Plane<Dim>& plane : planes_)
      for (std::size_t i = 0; i < fluid.size(); ++i) {
        if (fluid.is_buffer(i)) continue;
        const double stretch = std::max(0.0, range_ - plane.distance(fluid.node[i].x));
        sum += 0.5 * stiffness_ * stretch * stretch;
      }
    return sum;
  }

 private:
  std::vector<Plane<Dim>> planes_;
  double range_, stiffness_;  // [m], [N/m]
};

}  // namespace sluice::fluid
