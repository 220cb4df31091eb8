#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <tuple>
#include <vector>

#include "fluid/boundary.hpp"
#include "fluid/group_search.hpp"
#include "fluid/halo.hpp"
#include "fluid/parallel.hpp"
#include "fluid/particles.hpp"

namespace sluice::fluid {

// Neighbours of every item in a compact list: those of item i are index[begin[i]] .. index[begin[i+1] - 1].
struct NeighborList {
  std::vector<std::uint64_t> begin;
  std::vector<std::uint32_t> index;

  auto state() { return std::tie(begin, index); }

  [[nodiscard]] std::span<const std::uint32_t> of(std::size_t i) const {
    return {index.data() + begin[i], static_cast<std::size_t>(begin[i + 1] - begin[i])};
  }
};

// Which lists a search makes, and how it sorts.
struct SearchPlan {
  bool singles = true;       // of fluid near every fluid particle
  bool wall_singles = true;  // of boundary near every fluid particle, and the other way round
  bool groups = false;       // of groups of particles (group_list.hpp)
  double cell = 0;  // edge of the cells that the particles are sorted by [m]; 0: the reach of the search
};

// Finds all pairs within the support plus a skin, and keeps the lists until a particle may have crossed the
// skin. Pairs that a thin plate separates are left out here, so that the sweeps need not know.
template <int Dim>
class NeighborSearch {
 public:
  NeighborSearch(double support, double skin, const Period& period = {}, const SearchPlan& plan = {},
                 const Mirrors& mirrors = {})
      : support_(support),
        skin_(skin),
        plan_(plan),
        cell_(plan.cell > 0.0 ? plan.cell : support + skin),
        halo_(period, mirrors, halo_width(support, skin)) {}

  // Depth of the halo [m]: boundary particles up to one reach beyond a side with images take over the state
  // of fluid up to one reach from themselves.
  static double halo_width(double support, double skin) { return 2.0 * (support + skin); }
  Impulse take_impulse() { return halo_.take_impulse(); }
  // Neighbours may be images; what they are given is refreshed here.
  [[nodiscard]] const Halo<Dim>& halo() const { return halo_; }

  // How far a fluid particle has moved since the lists were made, or the one that moved most, squared [m^2];
  // without lists of these particles infinite.
  [[nodiscard]] double moved2(const Particles<Dim>& fluid, std::size_t i) const {
    return i < fluid_at_build_.size() ? (fluid.node[i].x - fluid_at_build_[i]).squaredNorm()
                                      : std::numeric_limits<double>::infinity();
  }
  [[nodiscard]] double moved2(const Particles<Dim>& fluid, const Parallel& parallel) const;
  // Whether motion demands a rebuild of the lists; of the fluid the largest moved2.
  [[nodiscard]] bool is_stale(double fluid_moved2, const BoundaryParticles<Dim>& boundary) const;
  // Sorts the fluid particles by cell and makes the lists.
  void rebuild(Particles<Dim>& fluid, const BoundaryParticles<Dim>& boundary, const Parallel& parallel);
  // The one if the other.
  void update(Particles<Dim>& fluid, const BoundaryParticles<Dim>& boundary, const Parallel& parallel);

  // Other fluid particles near a fluid particle.
  [[nodiscard]] std::span<const std::uint32_t> fluid_near_fluid(std::size_t i) const { return fluid_.of(i); }
  // Boundary particles near a fluid particle.
  [[nodiscard]] std::span<const std::uint32_t> boundary_near_fluid(std::size_t i) const {
    return boundary_.of(i);
  }
  // Boundary particles that have fluid near, and that fluid: entry a of the first is item a of the second.
  [[nodiscard]] const std::vector<std::uint32_t>& active_boundary() const { return active_; }
  [[nodiscard]] std::span<const std::uint32_t> fluid_near_active(std::size_t a) const {
    return active_list_.of(a);
  }

  // What is near groups of particles.
  [[nodiscard]] const GroupSearch<Dim>& groups() const { return groups_; }

  [[nodiscard]] std::uint64_t rebuilds() const { return rebuilds_; }

  // The lists, and the places that they were made for: sums stay in their order until the next rebuild.
  auto state() {
    return std::tie(halo_, fluid_at_build_, boundary_at_build_, fluid_, boundary_, active_list_, active_,
                    groups_, rebuilds_);
  }

 private:
  [[nodiscard]] bool needs_image(const Vec<Dim>& x, const BoundaryParticles<Dim>& boundary,
                                 const CellGrid<Dim>& walls) const;
  void list_singles(const Particles<Dim>& fluid, const BoundaryParticles<Dim>& boundary,
                    const SearchGrids<Dim>& grids, const Visibility<Dim>& visibility,
                    const Parallel& parallel);

  double support_, skin_;
  SearchPlan plan_;
  double cell_;
  Halo<Dim> halo_;
  std::vector<Vec<Dim>> fluid_at_build_, boundary_at_build_;
  NeighborList fluid_, boundary_, active_list_;
  std::vector<std::uint32_t> active_;
  GroupSearch<Dim> groups_;
  std::uint64_t rebuilds_ = 0;
};

extern template class NeighborSearch<2>;
extern template class NeighborSearch<3>;

}  // namespace sluice::fluid
