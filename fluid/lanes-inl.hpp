// Vectors of the instruction set in hand. Included anew for each one by the *_lanes.cpp.

#if defined(SLUICE_FLUID_LANES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SLUICE_FLUID_LANES_INL
#undef SLUICE_FLUID_LANES_INL
#else
#define SLUICE_FLUID_LANES_INL
#endif

#include <hwy/highway.h>

#include <bit>

#include "fluid/lanes.hpp"

HWY_BEFORE_NAMESPACE();
namespace sluice::fluid::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<double, kGroup>;
using V = hn::Vec<D>;
using M = hn::Mask<D>;

// Particles that a vector holds; a group is done in kGroup/kLanes turns.
inline constexpr std::size_t kLanes = hn::MaxLanes(D());

HWY_INLINE V set(double x) {
  return hn::Set(D(), x);
}
HWY_INLINE V load(const Lanes& lanes, std::size_t turn) {
  return hn::Load(D(), lanes.of.data() + turn);
}
HWY_INLINE void store(V x, Lanes& lanes, std::size_t turn) {
  hn::Store(x, D(), lanes.of.data() + turn);
}

template <int N>
struct Vecs {
  V a[N];
  HWY_INLINE V& operator[](int k) { return a[k]; }
  HWY_INLINE const V& operator[](int k) const { return a[k]; }
};

template <int N>
HWY_INLINE Vecs<N> zeros() {
  Vecs<N> z;
  for (int k = 0; k < N; ++k) z[k] = hn::Zero(D());
  return z;
}
template <std::size_t N>
HWY_INLINE Vecs<static_cast<int>(N)> load(const std::array<Lanes, N>& lanes, std::size_t turn) {
  Vecs<static_cast<int>(N)> v;
  for (std::size_t k = 0; k < N; ++k) v[static_cast<int>(k)] = load(lanes[k], turn);
  return v;
}
template <std::size_t N>
HWY_INLINE void store(const Vecs<static_cast<int>(N)>& v, std::array<Lanes, N>& lanes, std::size_t turn) {
  for (std::size_t k = 0; k < N; ++k) store(v[static_cast<int>(k)], lanes[k], turn);
}

template <int N>
HWY_INLINE V dot(const Vecs<N>& a, const Vecs<N>& b) {
  V sum = a[0] * b[0];
  for (int k = 1; k < N; ++k) sum = hn::MulAdd(a[k], b[k], sum);
  return sum;
}

// Neighbours that are weighed at once, into a buffer that stays in the first cache: a weight waits for a
// root, and sums that wait for it one by one would keep the next ones from starting.
inline constexpr std::size_t kChunk = 64;

// Loops over the components of vectors and matrices are unrolled whole, else they stay in memory.
#define SLUICE_UNROLL HWY_UNROLL(9)

// |x_j - x|^2.
template <int Dim>
HWY_INLINE V distance2(const Vecs<Dim>& x, const Node<Dim>& j) {
  Vecs<Dim> x_ij;
  SLUICE_UNROLL
  for (int a = 0; a < Dim; ++a) x_ij[a] = x[a] - set(j.x[a]);
  return dot(x_ij, x_ij);
}

// Entry of a symmetric matrix held by rows.
template <int Dim>
constexpr int sym(int a, int b) {
  return static_cast<int>(Symmetric<Dim>::place(a, b));
}

// m x, m symmetric.
template <int Dim>
HWY_INLINE Vecs<Dim> times(const Vecs<Dim*(Dim + 1) / 2>& m, const Vecs<Dim>& x) {
  Vecs<Dim> y;
  for (int a = 0; a < Dim; ++a) {
    y[a] = m[sym<Dim>(a, 0)] * x[0];
    for (int b = 1; b < Dim; ++b) y[a] = hn::MulAdd(m[sym<Dim>(a, b)], x[b], y[a]);
  }
  return y;
}

// Which lanes an item of a list acts on.
HWY_INLINE M lanes_of(const std::uint8_t* lanes, std::size_t item, std::size_t turn) {
  std::uint8_t bits[8] = {static_cast<std::uint8_t>(lanes[item] >> turn)};
  return hn::LoadMaskBits(D(), bits);
}

// Numbers of items, as many as there can be in a vector.
using DI = hn::CappedTag<std::uint32_t, kGroup>;
inline constexpr std::size_t kItems = hn::MaxLanes(DI());
using DPlace = hn::Rebind<std::uint8_t, DI>;

// Writes those of the eight items from `first` on that have a bit, and returns where they end. By a table:
// what processors have for this takes most of them longer.
HWY_INLINE std::uint32_t* write_members(std::uint32_t first, unsigned bits, std::uint32_t* to) {
  for (std::size_t turn = 0; turn < kGroup; turn += kItems) {
    const auto place = hn::PromoteTo(DI(), hn::LoadU(DPlace(), kPlaces[bits].data() + turn));
    hn::StoreU(hn::Add(hn::Set(DI(), first), place), DI(), to + turn);
  }
  return to + std::popcount(bits);
}

// All that is near.
HWY_INLINE std::span<const std::uint32_t> write_all(const NearItems& near,
                                                    std::vector<std::uint32_t>& buffer) {
  if (buffer.size() < near.count + kRoomBeyond) buffer.resize(near.count + kRoomBeyond);
  std::uint32_t* to = buffer.data();
  for (const Members& some : near.members) to = write_members(some.first(), some.bits(), to);
  return {buffer.data(), near.count};
}

// WendlandC2 of kernel.hpp but for its constants, by which the sums are multiplied at their end. With the way
// d = 2h - r to the edge of the support
//   W = value_factor() d^4 (5h/2 - d),   F = slope_factor() d^3,
// which takes four products fewer than with q.
struct Wendland {
  template <int Dim>
  HWY_INLINE explicit Wendland(const WendlandC2<Dim>& kernel)
      : support(set(kernel.support())), root(set(1.25 * kernel.support())) {}

  // d, from r^2.
  HWY_INLINE V from_edge(V r2) const { return hn::Max(hn::Zero(D()), support - hn::Sqrt(r2)); }

  HWY_INLINE V value_at(V d) const {
    const V d2 = d * d;
    return d2 * d2 * (root - d);
  }
  HWY_INLINE V value(V r2) const { return value_at(from_edge(r2)); }

  HWY_INLINE void value_and_slope_at(V d, V& w, V& f) const {
    const V d2 = d * d;
    f = d2 * d;
    w = d2 * d2 * (root - d);
  }

  template <int Dim>
  static double value_factor(const WendlandC2<Dim>& kernel) {
    const double s = kernel.support();
    return kernel.at_zero() * 4.0 / (s * s * s * s * s);
  }
  template <int Dim>
  static double slope_factor(const WendlandC2<Dim>& kernel) {
    const double s = kernel.support();
    return kernel.slope() / (s * s * s);
  }

  V support, root;
};

}  // namespace sluice::fluid::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
