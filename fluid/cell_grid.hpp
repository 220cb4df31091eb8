#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <vector>

#include "fluid/particles.hpp"

namespace sluice::fluid {

// Cubic cells over a box; items are filed by cell with a counting sort and by x within a cell. Cells are
// numbered row by row along x, to and fro, so that the cells of a row are consecutive, a neighbourhood is a
// few contiguous ranges, and items that follow each other are near each other, at the ends of rows too. Large
// grids are divided into columns along the last axis, to and fro likewise: what the neighbourhoods of a row
// or a layer share is still in the cache when the next one comes.
template <int Dim>
class CellGrid {
 public:
  // The grid over the bounding box of the nodes, in cells of at least `cell` [m]; larger ones where there
  // would be more than 4 cells per node.
  CellGrid(const std::vector<Node<Dim>>& nodes, double cell) : cell_(cell) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    low_.setConstant(kInfinity);
    Vec<Dim> high = Vec<Dim>::Constant(-kInfinity);
    for (const Node<Dim>& node : nodes) {
      if (!node.x.allFinite()) continue;
      low_ = low_.cwiseMin(node.x);
      high = high.cwiseMax(node.x);
    }
    if (!(low_[0] <= high[0])) low_ = high = Vec<Dim>::Zero();
    const double most = 4.0 * static_cast<double>(nodes.size()) + 1024.0;
    while (((high - low_) / cell_).array().ceil().max(1.0).prod() > most) cell_ *= 2.0;
    for (int a = 0; a < Dim; ++a) count_[a] = 1 + static_cast<std::int64_t>((high[a] - low_[a]) / cell_);
    for (int a = 0; a + 1 < Dim; ++a) {
      columns_[a] = (count_[a] + kWidth - 1) / kWidth;
      width_[a] = (count_[a] + columns_[a] - 1) / columns_[a];
    }
  }

  // Files the nodes: afterwards item() lists their indices cell by cell; the order of equal x is kept.
  void file(const std::vector<Node<Dim>>& nodes) {
    const std::size_t cells = cell_count();
    std::vector<std::uint32_t> cell_of(nodes.size());
    begin_.assign(cells + 1, 0);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      cell_of[i] = static_cast<std::uint32_t>(index(coordinates(nodes[i].x)));
      ++begin_[cell_of[i] + 1];
    }
    std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
    item_.resize(nodes.size());
    std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
    for (std::size_t i = 0; i < nodes.size(); ++i) item_[next[cell_of[i]]++] = static_cast<std::uint32_t>(i);
    const auto row_length = static_cast<std::size_t>(width_[0]);
    for (std::size_t c = 0; c < cells; ++c) sort_by_x(nodes, c, (c / row_length) % 2 != 0);
  }

  [[nodiscard]] const std::vector<std::uint32_t>& item() const { return item_; }

  // Calls visit(first, last), positions in item(), for every row of cells that meets the box. A box far
  // outside the grid meets none.
  template <typename Visit>
  void for_rows_in(const Vec<Dim>& low, const Vec<Dim>& high, const Visit& visit) const {
    Coordinates from, to;
    for (int a = 0; a < Dim; ++a) {
      const double lower = std::floor((low[a] - low_[a]) / cell_);
      const double upper = std::floor((high[a] - low_[a]) / cell_);
      const auto last = static_cast<double>(count_[a] - 1);
      if (!(upper >= 0.0 && lower <= last)) return;
      from[a] = static_cast<std::int64_t>(std::max(lower, 0.0));
      to[a] = static_cast<std::int64_t>(std::min(upper, last));
    }
    Coordinates c = from;
    if constexpr (Dim == 2) {
      for (c[1] = from[1]; c[1] <= to[1]; ++c[1]) visit_row(c, to[0], visit);
    } else {
      for (c[2] = from[2]; c[2] <= to[2]; ++c[2])
        for (c[1] = from[1]; c[1] <= to[1]; ++c[1]) visit_row(c, to[0], visit);
    }
  }

 private:
  using Coordinates = std::array<std::int64_t, Dim>;

  // Not-a-number goes to cell 0, where it harms nobody until the stability guard sees it.
  [[nodiscard]] Coordinates coordinates(const Vec<Dim>& x) const {
    Coordinates c;
    for (int a = 0; a < Dim; ++a) {
      const double k = (x[a] - low_[a]) / cell_;
      c[a] = k > 0.0 ? static_cast<std::int64_t>(std::min(k, static_cast<double>(count_[a] - 1))) : 0;
    }
    return c;
  }

  // Cells, with those beyond the grid that fill the last columns up.
  [[nodiscard]] std::size_t cell_count() const {
    std::int64_t cells = count_[Dim - 1];
    for (int a = 0; a + 1 < Dim; ++a) cells *= columns_[a] * width_[a];
    return static_cast<std::size_t>(cells);
  }

  // k, or what it is counted from the other end of n.
  static std::int64_t to_and_fro(std::int64_t k, std::int64_t n, std::int64_t turn) {
    return turn % 2 == 0 ? k : n - 1 - k;
  }

  // Number of the row along x: column by column, in them layer by layer.
  [[nodiscard]] std::int64_t row(const Coordinates& c) const {
    if constexpr (Dim == 2) {
      const std::int64_t column = c[0] / width_[0];
      return column * count_[1] + to_and_fro(c[1], count_[1], column);
    } else {
      const std::int64_t y = c[1] / width_[1];
      const std::int64_t column = y * columns_[0] + to_and_fro(c[0] / width_[0], columns_[0], y);
      const std::int64_t layer = column * count_[2] + to_and_fro(c[2], count_[2], column);
      return layer * width_[1] + to_and_fro(c[1] % width_[1], width_[1], c[2]);
    }
  }

  [[nodiscard]] std::int64_t index(const Coordinates& c) const {
    const std::int64_t r = row(c);
    return r * width_[0] + to_and_fro(c[0] % width_[0], width_[0], r);
  }

  // The cells from c to `last` along x: a range in every column.
  template <typename Visit>
  void visit_row(Coordinates c, std::int64_t last, const Visit& visit) const {
    while (c[0] <= last) {
      Coordinates end = c;
      end[0] = std::min(last, (c[0] / width_[0] + 1) * width_[0] - 1);
      const auto one = static_cast<std::size_t>(index(c)), other = static_cast<std::size_t>(index(end));
      visit(begin_[std::min(one, other)], begin_[std::max(one, other) + 1]);
      c[0] = end[0] + 1;
    }
  }

  // Insertion: from one filing to the next the order hardly changes.
  void sort_by_x(const std::vector<Node<Dim>>& nodes, std::size_t cell, bool falling) {
    const auto before = [&](std::uint32_t i, std::uint32_t j) {
      return falling ? nodes[i].x[0] > nodes[j].x[0] : nodes[i].x[0] < nodes[j].x[0];
    };
    for (std::size_t k = begin_[cell]; k < begin_[cell + 1]; ++k) {
      const std::uint32_t moved = item_[k];
      std::size_t to = k;
      for (; to > begin_[cell] && before(moved, item_[to - 1]); --to) item_[to] = item_[to - 1];
      item_[to] = moved;
    }
  }

  // Largest width of a column, in cells: what the neighbourhood of a row of it, or in space of a layer, takes
  // from the sweeps fits into half a megabyte of cache.
  static constexpr std::int64_t kWidth = Dim == 2 ? 64 : 8;

  double cell_;
  Vec<Dim> low_ = Vec<Dim>::Zero();
  Coordinates count_{};
  Coordinates columns_{}, width_{};  // of every axis but the last
  std::vector<std::uint32_t> begin_, item_;
};

}  // namespace sluice::fluid
