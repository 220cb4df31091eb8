#pragma once

#include <cstdint>
#include <vector>

#include "fluid/group_list.hpp"

namespace sluice::fluid {

// Of one group: which items of its list are within the support of each of the vectors that it is done in.
class CloseGroup {
 public:
  // Items to a word, a bit each.
  static constexpr std::size_t kWord = 64;

  CloseGroup(std::uint64_t* bits, std::size_t words) : bits_(bits), words_(words) {}

  // Word k has items kWord k and on; there is a word more behind the last.
  [[nodiscard]] std::uint64_t* of(std::size_t vector) const { return bits_ + vector * words_; }

 private:
  std::uint64_t* bits_;
  std::size_t words_;
};

// The fluid that sweep 1 finds within the support, for sweep 2 at the same positions: the lists of the search
// reach further, by the skin. A sixth of them is left out so in the plane, a quarter in space.
class CloseList {
 public:
  // Makes room for all that `list` holds. A group is done in `vectors` vectors.
  void fit(const GroupList& list, std::size_t vectors) {
    vectors_ = vectors;
    begin_.resize(list.size() + 1);
    begin_[0] = 0;
    for (std::size_t group = 0; group < list.size(); ++group)
      begin_[group + 1] = begin_[group] + (list.of(group).count + CloseGroup::kWord - 1) / CloseGroup::kWord;
    bits_.resize(begin_.back() * vectors + 1);
  }

  [[nodiscard]] CloseGroup of(std::size_t group) {
    return {bits_.data() + begin_[group] * vectors_, begin_[group + 1] - begin_[group]};
  }

 private:
  std::size_t vectors_ = 1;
  std::vector<std::size_t> begin_;  // words of groups before, for one vector
  std::vector<std::uint64_t> bits_;
};

}  // namespace sluice::fluid
