#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <tuple>
#include <vector>

#include "fluid/parallel.hpp"

namespace sluice::fluid {

// Eight consecutive particles, which the vectorised sweeps take a lane each (lanes.hpp): the widest vector of
// doubles there is. The sort keeps them close together, so that they share most of their neighbours.
inline constexpr std::size_t kGroup = 8;

inline constexpr std::size_t group_count(std::size_t particles) {
  return (particles + kGroup - 1) / kGroup;
}

// Edge of the cells by which particles are sorted [m]: they hold a group each on the lattice, 8 dx^Dim.
template <int Dim>
double group_edge(double spacing) {
  return (Dim == 2 ? 2.83 : 2.0) * spacing;
}

// What is near one group: every item that is near any particle of it.
struct NearGroup {
  std::span<const std::uint32_t> index;
  // For each item the particles of the group that it acts on, a bit each; null where it acts on all.
  const std::uint8_t* lanes = nullptr;
};

// Neighbours of every group, in blocks that are filled side by side and keep their memory.
class GroupList {
 public:
  // Groups a block: a task.
  static constexpr std::size_t kBlock = 32;

  struct Block {
    std::vector<std::uint32_t> index;
    std::array<std::uint32_t, kBlock + 1> begin{};
    std::vector<std::uint8_t> lanes;  // empty where no group needs them

    auto state() { return std::tie(index, begin, lanes); }
  };

  [[nodiscard]] std::size_t size() const { return groups_; }

  auto state() { return std::tie(groups_, block_); }

  [[nodiscard]] NearGroup of(std::size_t group) const {
    const Block& block = block_[group / kBlock];
    const std::size_t begin = block.begin[group % kBlock], end = block.begin[group % kBlock + 1];
    return {{block.index.data() + begin, end - begin},
            block.lanes.empty() ? nullptr : block.lanes.data() + begin};
  }

  // find(group, index) appends what is near a group; mask(group, item) gives the lanes that the item acts on,
  // and is asked where is_masked(group) says so.
  template <typename Find, typename IsMasked, typename Mask>
  void build(std::size_t groups, const Parallel& parallel, const Find& find, const IsMasked& is_masked,
             const Mask& mask) {
    groups_ = groups;
    block_.resize((groups + kBlock - 1) / kBlock);
    parallel.for_each(
        block_.size(),
        [&](std::size_t b) {
          Block& block = block_[b];
          block.index.clear();
          block.lanes.clear();
          for (std::size_t k = 0; k < kBlock; ++k) {
            const std::size_t group = b * kBlock + k;
            if (group < groups) find(group, block.index);
            block.begin[k + 1] = static_cast<std::uint32_t>(block.index.size());
          }
          for (std::size_t k = 0; k < kBlock; ++k)
            if (b * kBlock + k < groups && is_masked(b * kBlock + k))
              set_lanes(block, k, b * kBlock + k, mask);
        },
        1);
  }

 private:
  template <typename Mask>
  static void set_lanes(Block& block, std::size_t k, std::size_t group, const Mask& mask) {
    if (block.lanes.empty()) block.lanes.assign(block.index.size(), 0xFF);
    for (std::size_t n = block.begin[k]; n < block.begin[k + 1]; ++n)
      block.lanes[n] = mask(group, block.index[n]);
  }

  std::size_t groups_ = 0;
  std::vector<Block> block_;
};

}  // namespace sluice::fluid
