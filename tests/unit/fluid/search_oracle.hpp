#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <vector>

#include "fluid/neighbor_search.hpp"

namespace sluice::fluid {

// Particles as the search needs them, all else empty or zero.
template <int Dim>
Particles<Dim> particles_at(const std::vector<Vec<Dim>>& positions) {
  Particles<Dim> fluid;
  for (const Vec<Dim>& x : positions) fluid.node.push_back({x, Vec<Dim>::Zero(), 1.0, 1000.0});
  fluid.mass.assign(positions.size(), 1.0);
  fluid.acceleration.assign(positions.size(), Vec<Dim>::Zero());
  fluid.density_rate.assign(positions.size(), 0.0);
  fluid.id.resize(positions.size());
  std::iota(fluid.id.begin(), fluid.id.end(), 0u);
  return fluid;
}

template <int Dim>
Boundary boundary_at(const std::vector<Vec<Dim>>& positions) {
  Boundary boundary;
  for (const Vec<Dim>& x : positions) {
    boundary.position.push_back(widen<Dim>(x));
    boundary.volume.push_back(1.0);
    boundary.to_surface.emplace_back(0.0, 0.1, 0.0);
  }
  return boundary;
}

inline std::vector<std::uint32_t> sorted(std::span<const std::uint32_t> list) {
  std::vector<std::uint32_t> copy(list.begin(), list.end());
  std::sort(copy.begin(), copy.end());
  return copy;
}

// Whether `list` holds each of 0 .. count-1 that must be in it, none that may not, and none twice.
template <typename Must, typename May>
testing::AssertionResult holds(std::span<const std::uint32_t> list, std::size_t count, const Must& must,
                               const May& may) {
  const std::vector<std::uint32_t> in = sorted(list);
  if (std::adjacent_find(in.begin(), in.end()) != in.end())
    return testing::AssertionFailure() << "an entry is listed twice";
  for (std::uint32_t j = 0; j < count; ++j) {
    const bool listed = std::binary_search(in.begin(), in.end(), j);
    if (must(j) && !listed) return testing::AssertionFailure() << j << " is missing";
    if (!may(j) && listed) return testing::AssertionFailure() << j << " does not belong there";
  }
  if (!in.empty() && in.back() >= count) return testing::AssertionFailure() << in.back() << " is no index";
  return testing::AssertionSuccess();
}

// Compares the lists with all pairs: every pair nearer than `inner` must be listed, no pair beyond `outer`
// may be. admits_fluid(x, y) and admits_boundary(w, x) say which pairs count at all.
template <int Dim, typename AdmitsFluid, typename AdmitsBoundary>
testing::AssertionResult matches_all_pairs(const NeighborSearch<Dim>& search, const Particles<Dim>& fluid,
                                           const BoundaryParticles<Dim>& boundary, double inner, double outer,
                                           const AdmitsFluid& admits_fluid,
                                           const AdmitsBoundary& admits_boundary) {
  for (std::size_t i = 0; i < fluid.size(); ++i) {
    const Vec<Dim>& x = fluid.node[i].x;
    const auto fluid_within = [&](std::uint32_t j, double reach) {
      const Vec<Dim>& y = fluid.node[j].x;
      return i != j && (y - x).norm() < reach && admits_fluid(x, y);
    };
    const auto near = holds(
        search.fluid_near_fluid(i), fluid.size(), [&](auto j) { return fluid_within(j, inner); },
        [&](auto j) { return fluid_within(j, outer); });
    if (!near) return testing::AssertionFailure() << "fluid near fluid " << i << ": " << near.message();
    const auto boundary_within = [&](std::uint32_t w, double reach) {
      return (boundary.node()[w].x - x).norm() < reach && admits_boundary(w, x);
    };
    const auto wall = holds(
        search.boundary_near_fluid(i), boundary.size(), [&](auto w) { return boundary_within(w, inner); },
        [&](auto w) { return boundary_within(w, outer); });
    if (!wall) return testing::AssertionFailure() << "boundary near fluid " << i << ": " << wall.message();
  }
  return testing::AssertionSuccess();
}

template <int Dim>
testing::AssertionResult matches_all_pairs(const NeighborSearch<Dim>& search, const Particles<Dim>& fluid,
                                           const BoundaryParticles<Dim>& boundary, double inner,
                                           double outer) {
  const auto all = [](const auto&, const auto&) { return true; };
  return matches_all_pairs(search, fluid, boundary, inner, outer, all, all);
}

// Whether the list of fluid near active boundary particles is the transpose of boundary near fluid.
template <int Dim>
testing::AssertionResult is_transpose(const NeighborSearch<Dim>& search, const Particles<Dim>& fluid,
                                      const BoundaryParticles<Dim>& boundary) {
  std::vector<std::vector<std::uint32_t>> fluid_near(boundary.size());
  for (std::uint32_t i = 0; i < fluid.size(); ++i)
    for (const std::uint32_t w : search.boundary_near_fluid(i)) fluid_near[w].push_back(i);
  std::size_t active = 0;
  for (std::uint32_t w = 0; w < boundary.size(); ++w) {
    if (fluid_near[w].empty()) continue;
    if (active == search.active_boundary().size() || search.active_boundary()[active] != w)
      return testing::AssertionFailure() << "boundary particle " << w << " has fluid near, but is not active";
    if (sorted(search.fluid_near_active(active)) != fluid_near[w])
      return testing::AssertionFailure() << "fluid near boundary particle " << w << " differs";
    ++active;
  }
  if (active != search.active_boundary().size())
    return testing::AssertionFailure() << "active boundary particles without fluid near";
  return testing::AssertionSuccess();
}

}  // namespace sluice::fluid
