#pragma once

#include <algorithm>
#include <span>
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
      : range_(std::min(model.guard_range, 0.75 * model.spacing) - 0.5 * model.spacing),
        film_(0.4 * model.spacing),
        stiffness_(model.guard_stiffness) {
    for (int a = 0; a < Dim; ++a) {
      const auto side = static_cast<std::size_t>(2 * a);
      if (mirrors.at[side]) planes_.push_back({Vec<Dim>::Unit(a), mirrors.lower[a]});
      if (mirrors.at[side + 1]) planes_.push_back({-Vec<Dim>::Unit(a), -mirrors.upper[a]});
    }
  }

  void accelerate(std::size_t i, Particles<Dim>& fluid) const {
    for (const Plane<Dim>& plane : planes_) {
      const double stretch = range_ - plane.distance(fluid.node[i].x);
      if (stretch > 0.0) fluid.acceleration[i] += stiffness_ * stretch / fluid.mass[i] * plane.normal;
    }
  }

  // The sides, the fluid in front of them.
  [[nodiscard]] std::span<const Plane<Dim>> planes() const { return planes_; }

  // Whether a particle is nearer to a side than the row along it has room for. A wall does not hold fluid
  // back, and so nearly on top of its own image a film under tension pulls and pushes itself at the pace of
  // the steps: at twice their limit, it threw particles out at ten times the speed of the flow.
  [[nodiscard]] bool is_film(const Vec<Dim>& x) const {
    return std::any_of(planes_.begin(), planes_.end(),
                       [&](const Plane<Dim>& plane) { return plane.distance(x) < film_; });
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
  double range_, film_, stiffness_;  // [m], [m], [N/m]
};

}  // namespace sluice::fluid
