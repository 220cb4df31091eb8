#pragma once

#include <tuple>
#include <vector>

#include "fluid/boundary.hpp"
#include "fluid/cell_grid.hpp"
#include "fluid/group_list.hpp"
#include "fluid/parallel.hpp"
#include "fluid/particles.hpp"
#include "fluid/visibility.hpp"

namespace sluice::fluid {

// The grids of a search: of the fluid, whose particles lie in the order of its items, of the images behind
// them, likewise, and of the boundary.
template <int Dim>
struct SearchGrids {
  const CellGrid<Dim>& fluid;
  const CellGrid<Dim>& images;
  bool has_images;
  const CellGrid<Dim>& boundary;
};

// Lists of what is near groups of fluid and of boundary particles.
template <int Dim>
class GroupSearch {
 public:
  // Finds what is within `reach` [m]. Throws std::length_error for more particles than kMostItems.
  void rebuild(const Particles<Dim>& fluid, const BoundaryParticles<Dim>& boundary,
               const SearchGrids<Dim>& grids, const Visibility<Dim>& visibility, double reach,
               const Parallel& parallel);

  // Fluid near every group of fluid, its own particles among it.
  [[nodiscard]] const GroupList& fluid_near_fluid() const { return fluid_; }
  // Boundary particles near every group of fluid.
  [[nodiscard]] const GroupList& boundary_near_fluid() const { return boundary_; }
  // Boundary particles near one fluid particle, and few beyond the reach; `buffer` holds them.
  [[nodiscard]] std::span<const std::uint32_t> boundary_near_particle(
      std::size_t i, std::vector<std::uint32_t>& buffer) const;
  // Calls visit(k) for fluid near one fluid particle, itself among it, and for some beyond the reach.
  template <typename Visit>
  void for_fluid_near_particle(std::size_t i, const Visit& visit) const {
    fluid_.of(i / kGroup).for_each_of(i % kGroup, visit);
  }
  // Groups of boundary particles that have fluid near.
  [[nodiscard]] const std::vector<std::uint32_t>& active_boundary() const { return active_; }
  // Fluid near every group of boundary particles.
  [[nodiscard]] const GroupList& fluid_near_boundary() const { return of_boundary_; }
  // Fluid near one boundary particle, and some beyond the reach; `buffer` holds it.
  [[nodiscard]] std::span<const std::uint32_t> fluid_near_boundary_particle(
      std::size_t w, std::vector<std::uint32_t>& buffer) const;

  // Calls visit(i, w) for all pairs of fluid and of the `count` boundary particles.
  template <typename Visit>
  void for_boundary_pairs(std::size_t count, const Visit& visit) const {
    for (const std::uint32_t group : active_) {
      const NearItems near = of_boundary_.of(group);
      near.for_each([&](std::size_t n, std::uint32_t i) {
        for (std::size_t l = 0; l < kGroup && group * kGroup + l < count; ++l)
          if (near.lanes == nullptr || near.lanes[n] >> l & 1) visit(i, group * kGroup + l);
      });
    }
  }

  auto state() { return std::tie(fluid_, boundary_, of_boundary_, active_); }

 private:
  GroupList fluid_, boundary_, of_boundary_;
  std::vector<std::uint32_t> active_;
};

extern template class GroupSearch<2>;
extern template class GroupSearch<3>;

}  // namespace sluice::fluid
