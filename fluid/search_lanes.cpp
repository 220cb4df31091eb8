#include "fluid/lanes.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "fluid/search_lanes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "fluid/lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace sluice::fluid::HWY_NAMESPACE {

// Whether a point is near any particle of a group.
template <int Dim>
class Reach {
 public:
  HWY_INLINE Reach(const LaneVec<Dim>& group, double reach) : group_(group), reach2_(set(reach * reach)) {}

  HWY_INLINE bool has(const Node<Dim>& node) const {
    M near = is_near(node, 0);
    for (std::size_t turn = kLanes; turn < kGroup; turn += kLanes) near = hn::Or(near, is_near(node, turn));
    return !hn::AllFalse(D(), near);
  }

 private:
  HWY_INLINE M is_near(const Node<Dim>& node, std::size_t turn) const {
    Vecs<Dim> x;
    SLUICE_UNROLL
    for (int a = 0; a < Dim; ++a) x[a] = set(node.x[a]) - load(group_[static_cast<std::size_t>(a)], turn);
    return hn::Lt(dot(x, x), reach2_);
  }

  const LaneVec<Dim>& group_;
  V reach2_;
};

// Up to 64 at once: their bits first, in a loop as long as it can be.
template <int Dim>
HWY_INLINE void add_row(const LaneVec<Dim>& group, double reach, const Node<Dim>* node, std::uint32_t first,
                        std::uint32_t last, std::vector<Members>& members) {
  constexpr std::uint32_t kWord = 64;
  const Reach<Dim> near(group, reach);
  while (first < last) {
    const std::uint32_t eight = first / kGroup, start = eight * kGroup;
    const std::uint32_t end = std::min(last, start + kWord);
    std::uint64_t bits = 0;
    for (std::uint32_t k = first; k < end; ++k) bits |= std::uint64_t{near.has(node[k])} << (k - start);
    const std::size_t before = members.size();
    members.resize(before + group_count(end - start));
    Members* to = members.data() + before;
    for (std::uint32_t g = 0; g < group_count(end - start); ++g) {
      *to = Members(eight + g, static_cast<unsigned>(bits >> g * kGroup & 0xFF));
      to += to->bits() != 0 ? 1 : 0;
    }
    members.resize(static_cast<std::size_t>(to - members.data()));
    first = end;
  }
}

template <int Dim>
HWY_INLINE void add_some(const LaneVec<Dim>& group, double reach, const Node<Dim>* node,
                         std::span<const std::uint32_t> some, std::vector<Members>& members) {
  const Reach<Dim> near(group, reach);
  const std::size_t before = members.size();
  for (const std::uint32_t k : some)
    if (near.has(node[k])) add_item(k, before, members);
}

void add_row_2d(const LaneVec<2>& group, double reach, const Node<2>* node, std::uint32_t first,
                std::uint32_t last, std::vector<Members>& members) {
  add_row<2>(group, reach, node, first, last, members);
}
void add_row_3d(const LaneVec<3>& group, double reach, const Node<3>* node, std::uint32_t first,
                std::uint32_t last, std::vector<Members>& members) {
  add_row<3>(group, reach, node, first, last, members);
}
void add_some_2d(const LaneVec<2>& group, double reach, const Node<2>* node,
                 std::span<const std::uint32_t> some, std::vector<Members>& members) {
  add_some<2>(group, reach, node, some, members);
}
void add_some_3d(const LaneVec<3>& group, double reach, const Node<3>* node,
                 std::span<const std::uint32_t> some, std::vector<Members>& members) {
  add_some<3>(group, reach, node, some, members);
}

std::span<const std::uint32_t> unpack_all(const NearItems& near, std::vector<std::uint32_t>& buffer) {
  return write_all(near, buffer);
}

}  // namespace sluice::fluid::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sluice::fluid {

HWY_EXPORT(add_row_2d);
HWY_EXPORT(add_row_3d);
HWY_EXPORT(add_some_2d);
HWY_EXPORT(add_some_3d);
HWY_EXPORT(unpack_all);

template <>
void add_near<2>(const LaneVec<2>& group, double reach, const Node<2>* node, std::uint32_t first,
                 std::uint32_t last, std::vector<Members>& members) {
  HWY_DYNAMIC_DISPATCH(add_row_2d)(group, reach, node, first, last, members);
}
template <>
void add_near<3>(const LaneVec<3>& group, double reach, const Node<3>* node, std::uint32_t first,
                 std::uint32_t last, std::vector<Members>& members) {
  HWY_DYNAMIC_DISPATCH(add_row_3d)(group, reach, node, first, last, members);
}
template <>
void add_near<2>(const LaneVec<2>& group, double reach, const Node<2>* node,
                 std::span<const std::uint32_t> some, std::vector<Members>& members) {
  HWY_DYNAMIC_DISPATCH(add_some_2d)(group, reach, node, some, members);
}
template <>
void add_near<3>(const LaneVec<3>& group, double reach, const Node<3>* node,
                 std::span<const std::uint32_t> some, std::vector<Members>& members) {
  HWY_DYNAMIC_DISPATCH(add_some_3d)(group, reach, node, some, members);
}

NearGroup unpack(const NearItems& near, std::vector<std::uint32_t>& buffer) {
  if (near.count == 0) return {};
  return {HWY_DYNAMIC_DISPATCH(unpack_all)(near, buffer), near.lanes};
}

}  // namespace sluice::fluid
#endif
