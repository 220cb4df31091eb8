#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "fluid/group_list.hpp"

namespace sluice::fluid {

// Of one group: what is within the support of each of the vectors that it is done in.
class CloseGroup {
 public:
  CloseGroup(std::uint32_t* index, std::size_t room, std::uint32_t* count)
      : index_(index), room_(room), count_(count) {}

  // Where those of a vector are written.
  [[nodiscard]] std::uint32_t* begin(std::size_t vector) const { return index_ + vector * room_; }
  void end_at(const std::uint32_t* end, std::size_t vector) const {
    count_[vector] = static_cast<std::uint32_t>(end - begin(vector));
  }
  [[nodiscard]] std::span<const std::uint32_t> of(std::size_t vector) const {
    return {begin(vector), count_[vector]};
  }

 private:
  std::uint32_t* index_;
  std::size_t room_;
  std::uint32_t* count_;
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
      begin_[group + 1] = begin_[group] + list.of(group).index.size();
    index_.resize(begin_.back() * vectors);
    count_.resize(list.size() * vectors);
  }

  [[nodiscard]] CloseGroup of(std::size_t group) {
    return {index_.data() + begin_[group] * vectors_, begin_[group + 1] - begin_[group],
            count_.data() + group * vectors_};
  }

 private:
  std::size_t vectors_ = 1;
  std::vector<std::size_t> begin_;  // of groups in the lists
  std::vector<std::uint32_t> index_, count_;
};

}  // namespace sluice::fluid
