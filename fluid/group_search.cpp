#include "fluid/group_search.hpp"

#include <stdexcept>
#include <string>

#include "fluid/lanes.hpp"

namespace sluice::fluid {

namespace {

// Positions of a group and the box that holds all points within reach of it.
template <int Dim>
struct Surroundings {
  Surroundings(const std::vector<Node<Dim>>& node, std::size_t count, std::size_t group, double reach) {
    low = high = node[group * kGroup].x;
    for (std::size_t l = 0; l < kGroup; ++l) {
      const Vec<Dim>& p = node[std::min(group * kGroup + l, count - 1)].x;
      for (std::size_t a = 0; a < Dim; ++a) x[a][l] = p[static_cast<Eigen::Index>(a)];
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
    low.array() -= reach;
    high.array() += reach;
  }

  LaneVec<Dim> x;
  Vec<Dim> low, high;
};

// The lanes of a group for which yes(particle) holds; those behind the last particle do not matter.
template <typename Yes>
std::uint8_t lanes_where(std::size_t group, std::size_t count, const Yes& yes) {
  unsigned bits = 0;
  for (std::size_t l = 0; l < kGroup && group * kGroup + l < count; ++l)
    if (yes(group * kGroup + l)) bits |= 1u << l;
  return static_cast<std::uint8_t>(bits);
}

// What a list has for one particle of a group.
std::span<const std::uint32_t> of_particle(const GroupList& list, std::size_t i,
                                           std::vector<std::uint32_t>& buffer) {
  buffer.clear();
  list.of(i / kGroup).for_each_of(i % kGroup, [&](std::uint32_t k) { buffer.push_back(k); });
  return buffer;
}

}  // namespace

template <int Dim>
void GroupSearch<Dim>::rebuild(const Particles<Dim>& fluid, const BoundaryParticles<Dim>& boundary,
                               const SearchGrids<Dim>& grids, const Visibility<Dim>& visibility, double reach,
                               const Parallel& parallel) {
  if (std::max(fluid.node.size(), boundary.size()) > kMostItems)
    throw std::length_error("more than " + std::to_string(kMostItems) +
                            " particles with their images; a coarser spacing has fewer");
  const auto fluid_count = static_cast<std::uint32_t>(fluid.size());
  const auto add_fluid = [&](const Surroundings<Dim>& near, std::vector<Members>& members) {
    const auto add_row = [&](std::uint32_t first, std::uint32_t last) {
      add_near<Dim>(near.x, reach, fluid.node.data(), first, last, members);
    };
    grids.fluid.for_rows_in(near.low, near.high, add_row);
    if (!grids.has_images) return;
    grids.images.for_rows_in(near.low, near.high, [&](std::uint32_t first, std::uint32_t last) {
      add_row(fluid_count + first, fluid_count + last);
    });
  };
  const auto near_plate = [&](std::size_t group) {
    return lanes_where(group, fluid.size(), [&](std::size_t i) { return visibility.is_near_plate(i); }) != 0;
  };

  fluid_.build(
      group_count(fluid.size()), parallel,
      [&](std::size_t group, std::vector<Members>& members) {
        add_fluid(Surroundings<Dim>(fluid.node, fluid.size(), group, reach), members);
      },
      near_plate,
      [&](std::size_t group, std::uint32_t j) {
        return lanes_where(group, fluid.size(),
                           [&](std::size_t i) { return i == j || visibility.fluid_sees_fluid(i, j); });
      });

  boundary_.build(
      group_count(fluid.size()), parallel,
      [&](std::size_t group, std::vector<Members>& members) {
        const Surroundings<Dim> near(fluid.node, fluid.size(), group, reach);
        grids.boundary.for_rows_in(near.low, near.high, [&](std::uint32_t first, std::uint32_t last) {
          add_near<Dim>(near.x, reach, boundary.node().data(),
                        std::span(grids.boundary.item()).subspan(first, last - first), members);
        });
      },
      near_plate,
      [&](std::size_t group, std::uint32_t w) {
        return lanes_where(group, fluid.size(),
                           [&](std::size_t i) { return visibility.fluid_sees_boundary(i, w); });
      });

  of_boundary_.build(
      group_count(boundary.size()), parallel,
      [&](std::size_t group, std::vector<Members>& members) {
        add_fluid(Surroundings<Dim>(boundary.node(), boundary.size(), group, reach), members);
      },
      [&](std::size_t group) {
        return lanes_where(group, boundary.size(), [&](std::size_t w) { return boundary.plate(w) >= 0; }) !=
               0;
      },
      [&](std::size_t group, std::uint32_t j) {
        return lanes_where(group, boundary.size(),
                           [&](std::size_t w) { return visibility.fluid_sees_boundary(j, w); });
      });
  active_.clear();
  for (std::size_t group = 0; group < of_boundary_.size(); ++group)
    if (of_boundary_.of(group).count > 0) active_.push_back(static_cast<std::uint32_t>(group));
}

template <int Dim>
std::span<const std::uint32_t> GroupSearch<Dim>::boundary_near_particle(
    std::size_t i, std::vector<std::uint32_t>& buffer) const {
  return of_particle(boundary_, i, buffer);
}

template <int Dim>
std::span<const std::uint32_t> GroupSearch<Dim>::fluid_near_boundary_particle(
    std::size_t w, std::vector<std::uint32_t>& buffer) const {
  return of_particle(of_boundary_, w, buffer);
}

template class GroupSearch<2>;
template class GroupSearch<3>;

}  // namespace sluice::fluid
