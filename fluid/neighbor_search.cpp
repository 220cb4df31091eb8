#include "fluid/neighbor_search.hpp"

#include <algorithm>
#include <numeric>

#include "fluid/permute.hpp"
#include "fluid/visibility.hpp"

namespace sluice::fluid {

namespace {

// Counts, then fills: for_neighbors(i, emit) must call emit(j) for the neighbours of i in the same order both
// times.
template <typename ForNeighbors>
NeighborList make_list(std::size_t count, const Parallel& parallel, const ForNeighbors& for_neighbors) {
  NeighborList list;
  list.begin.assign(count + 1, 0);
  parallel.for_each(count, [&](std::size_t i) {
    std::uint64_t n = 0;
    for_neighbors(i, [&n](std::uint32_t) { ++n; });
    list.begin[i + 1] = n;
  });
  std::partial_sum(list.begin.begin(), list.begin.end(), list.begin.begin());
  list.index.resize(list.begin.back());
  parallel.for_each(count, [&](std::size_t i) {
    std::uint64_t at = list.begin[i];
    for_neighbors(i, [&](std::uint32_t j) { list.index[at++] = j; });
  });
  return list;
}

// Sorts what a particle carries from one step into the next.
template <int Dim>
void sort(Particles<Dim>& fluid, const std::vector<std::uint32_t>& order) {
  permute(fluid.mass, order);
  permute(fluid.node, order);
  permute(fluid.acceleration, order);
  permute(fluid.density_rate, order);
  permute(fluid.id, order);
  permute(fluid.opening, order);
  permute(fluid.liquid, order);
}

}  // namespace

template <int Dim>
void NeighborSearch<Dim>::update(Particles<Dim>& fluid, const BoundaryParticles<Dim>& boundary,
                                 const Parallel& parallel) {
  if (is_stale(moved2(fluid, parallel), boundary)) rebuild(fluid, boundary, parallel);
}

template <int Dim>
double NeighborSearch<Dim>::moved2(const Particles<Dim>& fluid, const Parallel& parallel) const {
  if (fluid_at_build_.size() != fluid.size()) return std::numeric_limits<double>::infinity();
  return parallel.max(fluid.size(), [&](std::size_t i) { return moved2(fluid, i); });
}

template <int Dim>
bool NeighborSearch<Dim>::is_stale(double fluid_moved2, const BoundaryParticles<Dim>& boundary) const {
  if (rebuilds_ == 0) return true;
  double boundary2 = 0;
  for (std::size_t w = 0; w < boundary.size(); ++w)
    boundary2 = std::max(boundary2, (boundary.node()[w].x - boundary_at_build_[w]).squaredNorm());
  // Two particles come nearer by at most the sum of their displacements.
  const double fluid_moved = std::sqrt(fluid_moved2), boundary_moved = std::sqrt(boundary2);
  return !(fluid_moved + std::max(fluid_moved, boundary_moved) < skin_);
}

// Of images further from the fluid than the reach the boundary particles near take the state over; other
// formulations than the default walk from image to image.
template <int Dim>
bool NeighborSearch<Dim>::needs_image(const Vec<Dim>& x, const BoundaryParticles<Dim>& boundary,
                                      const CellGrid<Dim>& walls) const {
  const double reach = support_ + skin_;
  if (plan_.singles || plan_.wall_singles || halo_.is_within(x, reach)) return true;
  bool found = false;
  walls.for_rows_in(x.array() - reach, x.array() + reach, [&](std::uint32_t first, std::uint32_t last) {
    for (std::uint32_t k = first; k < last && !found; ++k)
      found = (boundary.node()[walls.item()[k]].x - x).squaredNorm() < reach * reach;
  });
  return found;
}

template <int Dim>
void NeighborSearch<Dim>::rebuild(Particles<Dim>& fluid, const BoundaryParticles<Dim>& boundary,
                                  const Parallel& parallel) {
  const double reach = support_ + skin_;
  Halo<Dim>::remove(fluid);
  halo_.wrap(fluid);
  CellGrid<Dim> cells(fluid.node, cell_);
  cells.file(fluid.node);
  sort(fluid, cells.item());
  // Now particle k of the sorted order is item k of the grid, and image k after the particles item k of its.
  CellGrid<Dim> walls(boundary.node(), cell_);
  walls.file(boundary.node());
  const std::vector<Node<Dim>> images =
      halo_.find(fluid, [&](const Vec<Dim>& x) { return needs_image(x, boundary, walls); });
  CellGrid<Dim> image_cells(images, cell_);
  image_cells.file(images);
  halo_.append(fluid, image_cells.item());
  const SearchGrids<Dim> grids{cells, image_cells, !images.empty(), walls};
  const Visibility<Dim> visibility(fluid, boundary, reach);
  if (plan_.singles || plan_.wall_singles) list_singles(fluid, boundary, grids, visibility, parallel);
  if (plan_.groups) groups_.rebuild(fluid, boundary, grids, visibility, reach, parallel);

  fluid_at_build_.resize(fluid.size());
  for (std::size_t i = 0; i < fluid.size(); ++i) fluid_at_build_[i] = fluid.node[i].x;
  boundary_at_build_.resize(boundary.size());
  for (std::size_t w = 0; w < boundary.size(); ++w) boundary_at_build_[w] = boundary.node()[w].x;
  ++rebuilds_;
}

template <int Dim>
void NeighborSearch<Dim>::list_singles(const Particles<Dim>& fluid, const BoundaryParticles<Dim>& boundary,
                                       const SearchGrids<Dim>& grids, const Visibility<Dim>& visibility,
                                       const Parallel& parallel) {
  const double reach = support_ + skin_;
  const auto for_fluid_near = [&](const Vec<Dim>& x, const auto& visit) {
    const auto visit_row = [&](std::uint32_t first, std::uint32_t last) {
      for (std::uint32_t j = first; j < last; ++j)
        if ((fluid.node[j].x - x).squaredNorm() < reach * reach) visit(j);
    };
    const Vec<Dim> low = x.array() - reach, high = x.array() + reach;
    grids.fluid.for_rows_in(low, high, visit_row);
    if (!grids.has_images) return;
    const auto n = static_cast<std::uint32_t>(fluid.size());
    grids.images.for_rows_in(
        low, high, [&](std::uint32_t first, std::uint32_t last) { visit_row(n + first, n + last); });
  };

  if (plan_.singles)
    fluid_ = make_list(fluid.size(), parallel, [&](std::size_t i, const auto& emit) {
      for_fluid_near(fluid.node[i].x, [&](std::uint32_t j) {
        if (j != i && visibility.fluid_sees_fluid(i, j)) emit(j);
      });
    });
  if (!plan_.wall_singles) return;

  const NeighborList all = make_list(boundary.size(), parallel, [&](std::size_t w, const auto& emit) {
    for_fluid_near(boundary.node()[w].x, [&](std::uint32_t j) {
      if (visibility.fluid_sees_boundary(j, w)) emit(j);
    });
  });
  active_.clear();
  active_list_.begin.assign(1, 0);
  for (std::size_t w = 0; w < boundary.size(); ++w) {
    if (all.of(w).empty()) continue;
    active_.push_back(static_cast<std::uint32_t>(w));
    active_list_.begin.push_back(all.begin[w + 1]);
  }
  active_list_.index = all.index;

  // The transpose: boundary particles of every fluid particle, in rising order. Images need none.
  const auto is_image = [&](std::uint32_t j) { return j >= fluid.size(); };
  boundary_.begin.assign(fluid.size() + 1, 0);
  for (const std::uint32_t j : all.index)
    if (!is_image(j)) ++boundary_.begin[j + 1];
  std::partial_sum(boundary_.begin.begin(), boundary_.begin.end(), boundary_.begin.begin());
  boundary_.index.resize(boundary_.begin.back());
  std::vector<std::uint64_t> next(boundary_.begin.begin(), boundary_.begin.end() - 1);
  for (const std::uint32_t w : active_)
    for (const std::uint32_t j : all.of(w))
      if (!is_image(j)) boundary_.index[next[j]++] = w;
}

template class NeighborSearch<2>;
template class NeighborSearch<3>;

}  // namespace sluice::fluid
