#pragma once

#include <array>
#include <bit>
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

// Some of the items of one group, packed: the group's number, and below it a bit for each item. What is near
// a group is most of the items of the groups around it, so this takes a fifth of the memory of their numbers
// in the plane, an eighth in space.
class Members {
 public:
  Members() = default;
  Members(std::uint32_t group, unsigned bits) : packed_(group << kGroup | bits) {}

  [[nodiscard]] std::uint32_t group() const { return packed_ >> kGroup; }
  [[nodiscard]] unsigned bits() const { return packed_ & 0xFF; }
  [[nodiscard]] std::uint32_t first() const { return group() * static_cast<std::uint32_t>(kGroup); }
  [[nodiscard]] std::size_t count() const { return static_cast<std::size_t>(std::popcount(bits())); }

 private:
  static_assert(kGroup == 8);
  std::uint32_t packed_ = 0;
};
// So many items can be told apart so.
inline constexpr std::size_t kMostItems = std::size_t{1} << 27;

// Adds one item to those from `first` on: with the one before if it follows that in its group.
inline void add_item(std::uint32_t item, std::size_t first, std::vector<Members>& to) {
  const std::uint32_t group = item / kGroup;
  const unsigned bit = 1u << item % kGroup;
  if (to.size() > first && to.back().group() == group && to.back().bits() < bit)
    to.back() = Members(group, to.back().bits() | bit);
  else
    to.emplace_back(group, bit);
}

// What is near one group: every item that is near any particle of it, packed.
struct NearItems {
  std::span<const Members> members;
  std::size_t count;  // of items
  // For each item the particles of the group that it acts on, a bit each; null where it acts on all.
  const std::uint8_t* lanes;

  // Calls visit(n, item) for the n-th of them.
  template <typename Visit>
  void for_each(const Visit& visit) const {
    std::size_t n = 0;
    for (const Members& some : members)
      for (unsigned bits = some.bits(); bits != 0; bits &= bits - 1)
        visit(n++, some.first() + static_cast<std::uint32_t>(std::countr_zero(bits)));
  }
  // The same for those that act on one particle of the group.
  template <typename Visit>
  void for_each_of(std::size_t lane, const Visit& visit) const {
    for_each([&](std::size_t n, std::uint32_t item) {
      if (lanes == nullptr || lanes[n] >> lane & 1) visit(item);
    });
  }
};

// The same by the items' numbers.
struct NearGroup {
  std::span<const std::uint32_t> index;
  const std::uint8_t* lanes = nullptr;
};

// Neighbours of every group, in blocks that are filled side by side and keep their memory.
class GroupList {
 public:
  // Groups a block: a task.
  static constexpr std::size_t kBlock = 32;

  struct Block {
    std::vector<Members> members;
    std::array<std::uint32_t, kBlock + 1> begin{}, first_item{};
    std::vector<std::uint8_t> lanes;  // by item; empty where no group needs them

    auto state() { return std::tie(members, begin, first_item, lanes); }
  };

  [[nodiscard]] std::size_t size() const { return groups_; }

  auto state() { return std::tie(groups_, block_); }

  [[nodiscard]] NearItems of(std::size_t group) const {
    const Block& block = block_[group / kBlock];
    const std::size_t k = group % kBlock, begin = block.begin[k], end = block.begin[k + 1];
    return {{block.members.data() + begin, end - begin},
            block.first_item[k + 1] - block.first_item[k],
            block.lanes.empty() ? nullptr : block.lanes.data() + block.first_item[k]};
  }

  // find(group, members) adds what is near a group; mask(group, item) gives the lanes that the item acts on,
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
          block.members.clear();
          for (std::size_t k = 0; k < kBlock; ++k) {
            if (b * kBlock + k < groups) find(b * kBlock + k, block.members);
            block.begin[k + 1] = static_cast<std::uint32_t>(block.members.size());
          }
          if (block.members.capacity() > block.members.size() + block.members.size() / 2)
            block.members.shrink_to_fit();
          count_items(block);
          block.lanes.clear();
          for (std::size_t k = 0; k < kBlock; ++k)
            if (b * kBlock + k < groups && is_masked(b * kBlock + k)) set_lanes(block, b * kBlock + k, mask);
        },
        1);
  }

 private:
  static void count_items(Block& block) {
    for (std::size_t k = 0; k < kBlock; ++k) {
      std::uint32_t items = block.first_item[k];
      for (std::size_t n = block.begin[k]; n < block.begin[k + 1]; ++n)
        items += static_cast<std::uint32_t>(block.members[n].count());
      block.first_item[k + 1] = items;
    }
  }

  template <typename Mask>
  void set_lanes(Block& block, std::size_t group, const Mask& mask) {
    if (block.lanes.empty()) block.lanes.assign(block.first_item[kBlock], 0xFF);
    std::uint8_t* lanes = block.lanes.data() + block.first_item[group % kBlock];
    of(group).for_each([&](std::size_t n, std::uint32_t item) { lanes[n] = mask(group, item); });
  }

  std::size_t groups_ = 0;
  std::vector<Block> block_;
};

}  // namespace sluice::fluid
