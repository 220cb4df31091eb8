#pragma once

#include <span>
#include <vector>

#include "fluid/boundary.hpp"
#include "fluid/model.hpp"
#include "fluid/parallel.hpp"
#include "fluid/particles.hpp"
#include "fluid/wedged.hpp"

namespace sluice::fluid {

// Films that particles do not resolve: fluid caught between two surfaces, or pressed through one
// (wedged.hpp). Its own pressure would be that of one particle between stiff walls, whose forces do not match
// the work done on it: with it, heavy bodies that come down on a floor bring several times their energy in.
// So it counts as spray.
//   Where the surfaces keep their distance, as under a gate that rises slowly, its pressure goes to the mean
// of the liquid around it, in h/c0. Without any, a film drains what is at both its ends: under a gate at
// 12 mm/s forty particles gathered within a spacing, and flew apart when the gap had room for two rows. Where
// they do not, as under a body that comes down, there is no pressure: it would press the particle through
// the surface, or do the work of an impact on a body that has turned round. Nor is there inside a surface.
template <int Dim>
class Films {
 public:
  // From sweep 1's fits, which it marks, to the density rate that takes the pressure there.
  // boundary_near(i, buffer) are the boundary particles near fluid particle i, for_fluid_near(i, visit) calls
  // visit(k) for the fluid near, and maybe others beyond the support.
  template <typename Kernel, typename BoundaryNear, typename ForFluidNear>
  void find(const Model<Dim, Kernel>& model, const BoundaryParticles<Dim>& boundary,
            std::span<const Plane<Dim>> mirrors, const BoundaryNear& boundary_near,
            const ForFluidNear& for_fluid_near, const Parallel& parallel, Particles<Dim>& fluid) {
    kind_.resize(fluid.size());
    parallel.for_each(fluid.size(), [&](std::size_t i) {
      thread_local std::vector<std::uint32_t> buffer;
      kind_[i] = kind(model, fluid.node[i].x, boundary_near(i, buffer), boundary, mirrors);
      if (kind_[i] == Kind::none) return;
      fluid.fit[i].floored = true;
      fluid.divergence[i] = fluid.density_rate[i] = 0.0;
      if (kind_[i] == Kind::empty) fluid.node[i].rho = model.eos.rest_density();
    });
    const double per_time = model.eos.sound_speed() / model.h;
    parallel.for_each(fluid.size(), [&](std::size_t i) {
      if (kind_[i] != Kind::filled) return;
      const double excess = mean_density(model, for_fluid_near, fluid, i) - model.eos.rest_density();
      fluid.density_rate[i] = per_time * std::max(0.0, excess);
    });
  }

 private:
  // What has the pressure of the liquid around it, and what has none.
  enum class Kind : std::uint8_t { none, filled, empty };
  // Speed of the surfaces over c0 up to which they count as keeping their distance. With 0.01 one of 150
  // random scenes gained more than 1 % of energy by it.
  static constexpr double kSlow = 0.005;

  template <typename Kernel>
  static Kind kind(const Model<Dim, Kernel>& model, const Vec<Dim>& x, std::span<const std::uint32_t> near,
                   const BoundaryParticles<Dim>& boundary, std::span<const Plane<Dim>> mirrors) {
    if (near.empty()) return Kind::none;
    if (is_inside_boundary<Dim>(x, near, boundary)) return Kind::empty;
    const auto speed = film_speed<Dim>(model, x, near, boundary, mirrors);
    if (!speed) return Kind::none;
    return *speed > kSlow * model.eos.sound_speed() ? Kind::empty : Kind::filled;
  }

  // Of the fluid around i, weighted by V W; at rest where there is none.
  template <typename Kernel, typename ForFluidNear>
  static double mean_density(const Model<Dim, Kernel>& model, const ForFluidNear& for_fluid_near,
                             const Particles<Dim>& fluid, std::size_t i) {
    double rho = 0, weight = 0;
    for_fluid_near(i, [&](std::size_t k) {
      if (k == i) return;
      const Node<Dim>& node = fluid.node[k];
      const double VW = node.volume * model.kernel.value(node.x - fluid.node[i].x);
      rho += VW * node.rho;
      weight += VW;
    });
    return weight > 0.0 ? rho / weight : model.eos.rest_density();
  }

  std::vector<Kind> kind_;
};

}  // namespace sluice::fluid
