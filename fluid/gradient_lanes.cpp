#include "fluid/lanes.hpp"
#include "fluid/moments.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "fluid/gradient_lanes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "fluid/lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace sluice::fluid::HWY_NAMESPACE {

// Sums over the neighbours j, of their velocities and densities themselves: what belongs to those of the
// particle comes off at the end.
template <int Dim>
struct GradientSums {
  V m0, p;
  Vecs<Dim> m1, P, q;
  Vecs<Dim*(Dim + 1) / 2> m2;
  Vecs<Dim * Dim> Q;

  HWY_INLINE void clear() {
    m0 = p = hn::Zero(D());
    m1 = P = q = zeros<Dim>();
    m2 = zeros<Dim*(Dim + 1) / 2>();
    Q = zeros<Dim * Dim>();
  }

  HWY_INLINE void add(const Node<Dim>& j, const Vecs<Dim>& x, V VW) {
    m0 = m0 + VW;
    Vecs<Dim> x_ji, VWx;
    SLUICE_UNROLL
    for (int a = 0; a < Dim; ++a) {
      x_ji[a] = set(j.x[a]) - x[a];
      VWx[a] = VW * x_ji[a];
      m1[a] = m1[a] + VWx[a];
      P[a] = hn::MulAdd(VW, set(j.v[a]), P[a]);
    }
    SLUICE_UNROLL
    for (int ab = 0; ab < Dim * Dim; ++ab) {
      const int a = ab / Dim, b = ab % Dim;
      Q[ab] = hn::MulAdd(VWx[b], set(j.v[a]), Q[ab]);
      if (a <= b) m2[sym<Dim>(a, b)] = hn::MulAdd(VWx[a], x_ji[b], m2[sym<Dim>(a, b)]);
    }
    p = hn::MulAdd(VW, set(j.rho), p);
    SLUICE_UNROLL
    for (int a = 0; a < Dim; ++a) q[a] = hn::MulAdd(VWx[a], set(j.rho), q[a]);
  }

  // Relative to the particle's v and rho.
  HWY_INLINE void shift(const Vecs<Dim>& v, V rho) {
    SLUICE_UNROLL
    for (int a = 0; a < Dim; ++a) P[a] = hn::NegMulAdd(v[a], m0, P[a]);
    SLUICE_UNROLL
    for (int ab = 0; ab < Dim * Dim; ++ab) {
      const int a = ab / Dim, b = ab % Dim;
      Q[ab] = hn::NegMulAdd(v[a], m1[b], Q[ab]);
    }
    p = hn::NegMulAdd(rho, m0, p);
    SLUICE_UNROLL
    for (int a = 0; a < Dim; ++a) q[a] = hn::NegMulAdd(rho, m1[a], q[a]);
  }

  // By the kernel's constant, which the sums still lack.
  HWY_INLINE void scale(V factor) {
    m0 = m0 * factor;
    p = p * factor;
    SLUICE_UNROLL
    for (int a = 0; a < Dim; ++a) {
      m1[a] = m1[a] * factor;
      P[a] = P[a] * factor;
      q[a] = q[a] * factor;
    }
    for (V& m : m2.a) m = m * factor;
    for (V& product : Q.a) product = product * factor;
  }
};

// V W of the neighbours `first` and on, kChunk of them, as many as there are. With kClose those that are
// close go to `close`, and V W of them alone: everything is written, and kept where it counts. A branch there
// would be guessed wrong once in five. A bit each of `which` says which those are.
template <int Dim, bool kMasked, bool kClose>
HWY_INLINE std::size_t weigh(const Wendland& kernel, const Vecs<Dim>& x, std::size_t turn,
                             const NearNodes<Dim>& near, std::size_t first, std::uint32_t* close, V* VW,
                             std::uint64_t* which) {
  const std::size_t count = std::min(kChunk, near.near.index.size() - first);
  std::size_t kept = 0;
  std::uint64_t bits = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const std::uint32_t index = near.near.index[first + k];
    const Node<Dim>& j = near.node[index];
    const V d = kernel.from_edge(distance2(x, j));
    VW[kept] = set(j.volume) * kernel.value_at(d);
    if constexpr (kMasked)
      VW[kept] = hn::IfThenElseZero(lanes_of(near.near.lanes, first + k, turn), VW[kept]);
    if constexpr (kClose) {
      const std::uint64_t is_close = hn::AllFalse(D(), hn::Gt(d, hn::Zero(D()))) ? 0 : 1;
      close[kept] = index;
      bits |= is_close << k;
      kept += is_close;
    } else {
      ++kept;
    }
  }
  if constexpr (kClose) *which = bits;
  return kept;
}

// With kClose, `which` of the neighbours are close is written, a word a chunk.
template <int Dim, bool kMasked, bool kClose>
HWY_INLINE void gather(const Wendland& kernel, const NodeLanes<Dim>& group, std::size_t turn,
                       const NearNodes<Dim>& near, std::uint64_t* which, GradientSums<Dim>& sums) {
  static_assert(kChunk == CloseGroup::kWord);
  const Vecs<Dim> x = load(group.x, turn);
  GradientSums<Dim> s = sums;
  V VW[kChunk];
  std::uint32_t close[kChunk];
  for (std::size_t first = 0; first < near.near.index.size(); first += kChunk) {
    const std::size_t count = weigh<Dim, kMasked, kClose>(kernel, x, turn, near, first, close, VW, which);
    const std::uint32_t* index = kClose ? close : near.near.index.data() + first;
    for (std::size_t k = 0; k < count; ++k) s.add(near.node[index[k]], x, VW[k]);
    if constexpr (kClose) ++which;
  }
  sums = s;
}

template <int Dim>
HWY_INLINE void gather(const Wendland& kernel, const NodeLanes<Dim>& group, std::size_t turn,
                       const NearNodes<Dim>& near, GradientSums<Dim>& sums) {
  if (near.near.lanes == nullptr)
    gather<Dim, false, false>(kernel, group, turn, near, nullptr, sums);
  else
    gather<Dim, true, false>(kernel, group, turn, near, nullptr, sums);
}

// The inverse and whether all eigenvalues are above `floor`, as in moments.hpp.
template <int Dim>
HWY_INLINE M invert(const Vecs<Dim*(Dim + 1) / 2>& C, V floor, Vecs<Dim*(Dim + 1) / 2>& G) {
  const V one = set(1.0), zero = hn::Zero(D());
  if constexpr (Dim == 2) {
    const V per_det = one / (C[0] * C[2] - C[1] * C[1]);
    G[0] = C[2] * per_det;
    G[1] = hn::Neg(C[1]) * per_det;
    G[2] = C[0] * per_det;
    const V b0 = C[0] - floor;
    return hn::And(hn::Gt(b0, zero), hn::Gt(b0 * (C[2] - floor) - C[1] * C[1], zero));
  } else {
    G[0] = C[3] * C[5] - C[4] * C[4];
    G[1] = C[2] * C[4] - C[1] * C[5];
    G[2] = C[1] * C[4] - C[2] * C[3];
    G[3] = C[0] * C[5] - C[2] * C[2];
    G[4] = C[1] * C[2] - C[0] * C[4];
    G[5] = C[0] * C[3] - C[1] * C[1];
    const V per_det = one / (C[0] * G[0] + C[1] * G[1] + C[2] * G[2]);
    for (int k = 0; k < 6; ++k) G[k] = G[k] * per_det;
    const V b0 = C[0] - floor, b1 = C[3] - floor, b2 = C[5] - floor;
    const V minor = b0 * b1 - C[1] * C[1];
    const V det =
        b0 * (b1 * b2 - C[4] * C[4]) + C[1] * (C[2] * C[4] - C[1] * b2) + C[2] * (C[1] * C[4] - C[2] * b1);
    return hn::And(hn::Gt(b0, zero), hn::And(hn::Gt(minor, zero), hn::Gt(det, zero)));
  }
}

// Where an eigenvalue is below the floor: one by one, as that is rare.
template <int Dim>
void set_floored(const LaneSym<Dim>& C, double floor, std::size_t lane, GradientLanes<Dim>& out) {
  Mat<Dim> c;
  SLUICE_UNROLL
  for (int a = 0; a < Dim; ++a)
    for (int b = 0; b < Dim; ++b) c(a, b) = C[static_cast<std::size_t>(sym<Dim>(a, b))][lane];
  bool floored = true;
  const Mat<Dim> G = floored_inverse<Dim>(c, floor, floored);
  SLUICE_UNROLL
  for (int a = 0; a < Dim; ++a)
    for (int b = a; b < Dim; ++b) out.G[static_cast<std::size_t>(sym<Dim>(a, b))][lane] = G(a, b);
  out.floored[lane] = floored;
}

// The gradients that follow from the fit.
template <int Dim>
HWY_INLINE void finish_gradients(const GradientSums<Dim>& s, const Vecs<Dim>& g,
                                 const Vecs<Dim*(Dim + 1) / 2>& G, std::size_t turn,
                                 GradientLanes<Dim>& out) {
  const V half = set(0.5), quarter = set(0.25);
  Vecs<Dim> grad_rho = times<Dim>(G, s.q);
  Vecs<Dim * Dim> L;
  SLUICE_UNROLL
  for (int a = 0; a < Dim; ++a) {
    grad_rho[a] = half * hn::MulAdd(s.p, g[a], grad_rho[a]);
    Vecs<Dim> row;
    for (int b = 0; b < Dim; ++b) row[b] = s.Q[a * Dim + b];
    const Vecs<Dim> QG = times<Dim>(G, row);
    for (int b = 0; b < Dim; ++b) L[a * Dim + b] = hn::MulAdd(s.P[a], g[b], QG[b]);
  }
  store(grad_rho, out.half_grad_rho, turn);
  Vecs<Dim*(Dim + 1) / 2> strain;
  V divergence = L[0];
  SLUICE_UNROLL
  for (int a = 0; a < Dim; ++a) {
    if (a > 0) divergence = divergence + L[a * Dim + a];
    strain[sym<Dim>(a, a)] = half * L[a * Dim + a];
    for (int b = a + 1; b < Dim; ++b) strain[sym<Dim>(a, b)] = quarter * (L[a * Dim + b] + L[b * Dim + a]);
  }
  store(strain, out.half_strain, turn);
  store(divergence, out.divergence, turn);
}

template <int Dim>
HWY_INLINE void finish(const GradientSums<Dim>& s, double moment_floor, std::size_t turn,
                       GradientLanes<Dim>& out) {
  const V per_m0 = set(1.0) / s.m0;
  Vecs<Dim> mean;
  SLUICE_UNROLL
  for (int a = 0; a < Dim; ++a) mean[a] = s.m1[a] * per_m0;
  Vecs<Dim*(Dim + 1) / 2> C, G;
  SLUICE_UNROLL
  for (int a = 0; a < Dim; ++a)
    for (int b = a; b < Dim; ++b) C[sym<Dim>(a, b)] = hn::NegMulAdd(s.m1[a], mean[b], s.m2[sym<Dim>(a, b)]);
  const V floor = set(moment_floor) * hn::Max(set(1.0), s.m0);
  const M above = invert<Dim>(C, floor, G);
  store(G, out.G, turn);
  std::uint8_t bits[8] = {};
  hn::StoreMaskBits(D(), above, bits);
  for (std::size_t l = 0; l < kLanes; ++l) out.floored[turn + l] = (bits[0] >> l & 1) == 0;
  if (!hn::AllTrue(D(), above)) {
    LaneSym<Dim> c;
    Lanes floors;
    store(C, c, turn);
    store(floor, floors, turn);
    for (std::size_t l = turn; l < turn + kLanes; ++l)
      if (out.floored[l]) set_floored<Dim>(c, floors[l], l, out);
    G = load(out.G, turn);
  }
  Vecs<Dim> g = times<Dim>(G, mean);
  SLUICE_UNROLL
  for (int a = 0; a < Dim; ++a) g[a] = hn::Neg(g[a]);
  store(s.m0, out.m0, turn);
  store(g, out.g, turn);
  finish_gradients<Dim>(s, g, G, turn, out);
}

template <int Dim>
HWY_INLINE void gather_all(const LaneModel<Dim>& model, const NodeLanes<Dim>& group,
                           const NearNodes<Dim>& fluid, const NearNodes<Dim>& boundary,
                           const CloseGroup& close, GradientLanes<Dim>& out) {
  const Wendland kernel(model.kernel);
  for (std::size_t turn = 0; turn < kGroup; turn += kLanes) {
    GradientSums<Dim> sums;
    sums.clear();
    if (fluid.near.lanes == nullptr)
      gather<Dim, false, true>(kernel, group, turn, fluid, close.of(turn / kLanes), sums);
    else
      gather<Dim, true, false>(kernel, group, turn, fluid, nullptr, sums);
    gather<Dim>(kernel, group, turn, boundary, sums);
    sums.shift(load(group.v, turn), load(group.rho, turn));
    sums.scale(set(Wendland::value_factor(model.kernel)));
    finish<Dim>(sums, model.moment_floor, turn, out);
  }
}

void gradients_2d(const LaneModel<2>& model, const NodeLanes<2>& group, const NearNodes<2>& fluid,
                  const NearNodes<2>& boundary, const CloseGroup& close, GradientLanes<2>& out) {
  gather_all<2>(model, group, fluid, boundary, close, out);
}
void gradients_3d(const LaneModel<3>& model, const NodeLanes<3>& group, const NearNodes<3>& fluid,
                  const NearNodes<3>& boundary, const CloseGroup& close, GradientLanes<3>& out) {
  gather_all<3>(model, group, fluid, boundary, close, out);
}

std::size_t vectors() {
  return kGroup / kLanes;
}

}  // namespace sluice::fluid::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sluice::fluid {

HWY_EXPORT(gradients_2d);
HWY_EXPORT(gradients_3d);
HWY_EXPORT(vectors);

std::size_t vectors_of_group() {
  return HWY_DYNAMIC_DISPATCH(vectors)();
}

template <>
void gather_gradients(const LaneModel<2>& model, const NodeLanes<2>& group, const NearNodes<2>& fluid,
                      const NearNodes<2>& boundary, const CloseGroup& close, GradientLanes<2>& out) {
  HWY_DYNAMIC_DISPATCH(gradients_2d)(model, group, fluid, boundary, close, out);
}
template <>
void gather_gradients(const LaneModel<3>& model, const NodeLanes<3>& group, const NearNodes<3>& fluid,
                      const NearNodes<3>& boundary, const CloseGroup& close, GradientLanes<3>& out) {
  HWY_DYNAMIC_DISPATCH(gradients_3d)(model, group, fluid, boundary, close, out);
}

}  // namespace sluice::fluid
#endif
