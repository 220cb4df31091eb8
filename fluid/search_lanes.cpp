#include "fluid/lanes.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "fluid/search_lanes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "fluid/lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace sluice::fluid::HWY_NAMESPACE {

template <int Dim>
HWY_INLINE M within(const LaneVec<Dim>& group, V reach2, const Node<Dim>& node, std::size_t turn) {
  Vecs<Dim> x;
  SLUICE_UNROLL
  for (int a = 0; a < Dim; ++a) x[a] = set(node.x[a]) - load(group[static_cast<std::size_t>(a)], turn);
  return hn::Lt(dot(x, x), reach2);
}

template <int Dim>
HWY_INLINE void append(const LaneVec<Dim>& group, double reach, const Node<Dim>* node, std::uint32_t first,
                       std::uint32_t last, const std::uint32_t* item, std::vector<std::uint32_t>& out) {
  const std::size_t before = out.size();
  out.resize(before + last - first);
  std::uint32_t* to = out.data() + before;
  const V reach2 = set(reach * reach);
  for (std::uint32_t k = first; k < last; ++k) {
    const std::uint32_t j = item == nullptr ? k : item[k];
    M near = within<Dim>(group, reach2, node[j], 0);
    for (std::size_t turn = kLanes; turn < kGroup; turn += kLanes)
      near = hn::Or(near, within<Dim>(group, reach2, node[j], turn));
    *to = j;
    to += hn::AllFalse(D(), near) ? 0 : 1;
  }
  out.resize(static_cast<std::size_t>(to - out.data()));
}

void append_2d(const LaneVec<2>& group, double reach, const Node<2>* node, std::uint32_t first,
               std::uint32_t last, const std::uint32_t* item, std::vector<std::uint32_t>& out) {
  append<2>(group, reach, node, first, last, item, out);
}
void append_3d(const LaneVec<3>& group, double reach, const Node<3>* node, std::uint32_t first,
               std::uint32_t last, const std::uint32_t* item, std::vector<std::uint32_t>& out) {
  append<3>(group, reach, node, first, last, item, out);
}

}  // namespace sluice::fluid::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sluice::fluid {

HWY_EXPORT(append_2d);
HWY_EXPORT(append_3d);

template <>
void append_near<2>(const LaneVec<2>& group, double reach, const Node<2>* node, std::uint32_t first,
                    std::uint32_t last, const std::uint32_t* item, std::vector<std::uint32_t>& out) {
  HWY_DYNAMIC_DISPATCH(append_2d)(group, reach, node, first, last, item, out);
}
template <>
void append_near<3>(const LaneVec<3>& group, double reach, const Node<3>* node, std::uint32_t first,
                    std::uint32_t last, const std::uint32_t* item, std::vector<std::uint32_t>& out) {
  HWY_DYNAMIC_DISPATCH(append_3d)(group, reach, node, first, last, item, out);
}

}  // namespace sluice::fluid
#endif
