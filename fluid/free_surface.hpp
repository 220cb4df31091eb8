#pragma once

#include <cstdint>
#include <tuple>
#include <vector>

#include "fluid/model.hpp"
#include "fluid/neighbor_search.hpp"
#include "fluid/parallel.hpp"
#include "fluid/particles.hpp"

namespace sluice::fluid {

// A particle is at the surface where there is little around it (on a calm surface m0 = 0.76, one row below
// 0.99) and that on one side (there |g| dx is 1.7 and 0.06). In torn fluid inside, one of the two may be so,
// not both.
template <int Dim, typename Kernel>
bool is_at_surface(const Model<Dim, Kernel>& model, const Fit<Dim>& fit) {
  return fit.m0 < 0.85 && fit.g.norm() * model.spacing > 0.5;
}

// Which fluid particles are at the free surface, which see one of those, and where it is.
template <int Dim>
class FreeSurface {
 public:
  // Looks at all particles, images included.
  template <typename Kernel>
  void detect(const Model<Dim, Kernel>& model, const Particles<Dim>& fluid, const Parallel& parallel) {
    at_surface_.resize(fluid.node.size());
    parallel.for_each(at_surface_.size(),
                      [&](std::size_t i) { at_surface_[i] = is_at_surface(model, fluid.fit[i]); });
  }

  // Whether there is no surface in the support of particle i.
  [[nodiscard]] bool is_deep(std::size_t i, const NeighborSearch<Dim>& search) const {
    if (at_surface_[i]) return false;
    for (const std::uint32_t j : search.fluid_near_fluid(i))
      if (at_surface_[j]) return false;
    return true;
  }

  // Unit vector into the fluid, the mean of those of the surface in the support of particle i; zero where it
  // is deep.
  [[nodiscard]] Vec<Dim> normal(std::size_t i, const Particles<Dim>& fluid,
                                const NeighborSearch<Dim>& search) const {
    Vec<Dim> sum = Vec<Dim>::Zero();
    if (at_surface_[i]) sum += fluid.fit[i].g;
    for (const std::uint32_t j : search.fluid_near_fluid(i))
      if (at_surface_[j]) sum += fluid.fit[j].g;
    return sum.normalized();
  }

  auto state() { return std::tie(at_surface_); }

 private:
  std::vector<std::uint8_t> at_surface_;
};

}  // namespace sluice::fluid
