#include <bit>
#include <cstring>

#include "fluid/lanes.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "fluid/force_lanes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "fluid/lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace sluice::fluid::HWY_NAMESPACE {

// The penetration guard, guard_force of force_sweep.hpp: added to `force`.
template <int Dim>
HWY_INLINE void add_guard(const LaneModel<Dim>& model, M on, V r2, const Vecs<Dim>& x, Vecs<Dim>& force) {
  const M near = hn::And(on, hn::Lt(r2, set(model.guard_range * model.guard_range)));
  if (HWY_LIKELY(hn::AllFalse(D(), near))) return;
  const V r = hn::Sqrt(r2 + set(model.tiny_r2));
  const V spring = set(model.guard_stiffness) * (set(model.guard_range) / r - set(1.0));
  SLUICE_UNROLL
  for (int a = 0; a < Dim; ++a) force[a] = hn::MulAdd(hn::IfThenElseZero(near, spring), x[a], force[a]);
}

template <int Dim>
struct ForceSums {
  Vecs<Dim> internal, viscous, traction;
  Vecs<Dim> pairwise;  // [N]
  V diffusion;

  HWY_INLINE void clear() {
    internal = viscous = traction = pairwise = zeros<Dim>();
    diffusion = hn::Zero(D());
  }
};

// Where a neighbour stands, found one neighbour ahead: all else of a pair waits for the root and the
// division.
template <int Dim>
struct Ahead {
  Vecs<Dim> x_ik;
  V d, per_r2;  // from the edge of the support; 1/r^2
};

// What a fluid particle distributes of its stress, without W: s + S x of Source (particles.hpp), or over V
// sigma, where that is a number, g + G x of its fit.
template <int Dim, typename Matrix>
HWY_INLINE Vecs<Dim> flux_of(const Vec<Dim>& s, const Matrix& S, const Vecs<Dim>& x) {
  Vecs<Dim> flux;
  SLUICE_UNROLL
  for (int a = 0; a < Dim; ++a) flux[a] = set(s[a]);
  SLUICE_UNROLL
  for (int ab = 0; ab < Dim * Dim; ++ab) {
    const int a = ab / Dim, b = ab % Dim;
    flux[a] = hn::MulAdd(set(S(a, b)), x[b], flux[a]);
  }
  return flux;
}

template <int Dim, bool kMasked, bool kIsotropic>
HWY_INLINE void gather_fluid(const LaneModel<Dim>& model, const NodeLanes<Dim>& group,
                             const ForceLanes<Dim>& lanes, std::size_t turn,
                             std::span<const std::uint32_t> near, const std::uint8_t* mask,
                             const Particles<Dim>& particles, ForceSums<Dim>& sums) {
  const Node<Dim>* node = particles.node.data();
  const Wendland kernel(model.kernel);
  const Vecs<Dim> x = load(group.x, turn), v = load(group.v, turn),
                  grad_rho = load(lanes.half_grad_rho, turn);
  const Vecs<Dim*(Dim + 1) / 2> strain = load(lanes.half_strain, turn);
  const V rho = load(group.rho, turn), tiny_r2 = set(model.tiny_r2);
  ForceSums<Dim> s = sums;
  if (near.empty()) return;
  const auto look = [&](std::size_t n) HWY_ATTR {
    const Node<Dim>& k = node[near[n]];
    Ahead<Dim> ahead;
    SLUICE_UNROLL
    for (int a = 0; a < Dim; ++a) ahead.x_ik[a] = x[a] - set(k.x[a]);
    const V r2 = dot(ahead.x_ik, ahead.x_ik);
    ahead.d = kernel.from_edge(r2);
    ahead.per_r2 = set(1.0) / (r2 + tiny_r2);
    return ahead;
  };
  Ahead<Dim> next = look(0);
  for (std::size_t n = 0; n < near.size(); ++n) {
    const Node<Dim>& k = node[near[n]];
    const FlowGradients<Dim>& flow = particles.gradients[near[n]];
    const Vecs<Dim> x_ik = next.x_ik;
    const V per_r2 = next.per_r2;
    V W, F;
    kernel.value_and_slope_at(next.d, W, F);
    next = look(n + 1 < near.size() ? n + 1 : n);
    if constexpr (kMasked) {
      const M on = lanes_of(mask, n, turn);
      W = hn::IfThenElseZero(on, W);
      F = hn::IfThenElseZero(on, F);
    }
    // The differences of velocity and density that the gradients leave unexplained.
    Vecs<Dim> v_left;
    V rho_left = set(k.rho) - rho;
    SLUICE_UNROLL
    for (int a = 0; a < Dim; ++a) {
      v_left[a] = v[a] - set(k.v[a]);
      rho_left = hn::MulAdd(grad_rho[a] + set(flow.half_grad_rho[a]), x_ik[a], rho_left);
    }
    SLUICE_UNROLL
    for (int ab = 0; ab < Dim * Dim; ++ab) {
      const int a = ab / Dim, b = ab % Dim;
      v_left[a] = hn::NegMulAdd(strain[sym<Dim>(a, b)] + set(flow.half_strain(a, b)), x_ik[b], v_left[a]);
    }
    const V VF = set(k.volume) * F;
    const V viscous = VF * dot(v_left, x_ik) * per_r2;
    Vecs<Dim> flux;
    if constexpr (kIsotropic) {
      const Fit<Dim>& from = particles.fit[near[n]];
      flux = flux_of<Dim>(from.g, from.G, x_ik);
      W = W * set(flow.V_sigma);
    } else {
      const Source<Dim>& from = particles.source[near[n]];
      flux = flux_of<Dim>(from.s, from.S, x_ik);
    }
    SLUICE_UNROLL
    for (int a = 0; a < Dim; ++a) {
      s.internal[a] = hn::MulAdd(W, flux[a], s.internal[a]);
      s.viscous[a] = hn::NegMulAdd(viscous, x_ik[a], s.viscous[a]);
    }
    s.diffusion = hn::MulAdd(VF, rho_left, s.diffusion);
  }
  sums = s;
}

template <int Dim>
HWY_INLINE void gather_boundary(const LaneModel<Dim>& model, const NodeLanes<Dim>& group, std::size_t turn,
                                const NearGroup& near, const BoundaryParticles<Dim>& walls,
                                ForceSums<Dim>& sums) {
  const Wendland kernel(model.kernel);
  const Vecs<Dim> x = load(group.x, turn);
  const bool is_viscous = !walls.stress.empty();
  M on = hn::Eq(hn::Zero(D()), hn::Zero(D()));
  for (std::size_t n = 0; n < near.index.size(); ++n) {
    const std::uint32_t w = near.index[n];
    if (near.lanes != nullptr) on = lanes_of(near.lanes, n, turn);
    Vecs<Dim> x_iw;
    SLUICE_UNROLL
    for (int a = 0; a < Dim; ++a) x_iw[a] = x[a] - set(walls.node()[w].x[a]);
    const V r2 = dot(x_iw, x_iw);
    const V W = hn::IfThenElseZero(on, set(walls.sampled_volume(w)) * kernel.value(r2));
    const V Wp = W * set(walls.pressure[w]);
    SLUICE_UNROLL
    for (int a = 0; a < Dim; ++a) sums.traction[a] = hn::MulAdd(Wp, x_iw[a], sums.traction[a]);
    if (is_viscous) SLUICE_UNROLL
    for (int ab = 0; ab < Dim * Dim; ++ab) {
      V& traction = sums.traction[ab / Dim];
      traction = hn::NegMulAdd(W * set(walls.stress[w](ab / Dim, ab % Dim)), x_iw[ab % Dim], traction);
    }
    add_guard<Dim>(model, on, r2, x_iw, sums.pairwise);
    if (const ReturnedForce<Dim>* back = walls.returned(w)) {
      const V W_w = hn::IfThenElseZero(on, set(Wendland::value_factor(model.kernel)) * kernel.value(r2));
      for (int a = 0; a < Dim; ++a) {
        V returned = set(back->s[a]);
        for (int b = 0; b < Dim; ++b) returned = hn::MulAdd(set(back->S(a, b)), x_iw[b], returned);
        sums.pairwise[a] = hn::MulAdd(W_w, returned, sums.pairwise[a]);
      }
    }
  }
}

// `bits` at the places where `mask` has ones, from the lowest on.
HWY_INLINE unsigned deposit(std::uint64_t bits, unsigned mask) {
#if HWY_TARGET <= HWY_AVX2 && HWY_ARCH_X86_64
  return static_cast<unsigned>(_pdep_u64(bits, mask));
#else
  unsigned placed = 0;
  for (; mask != 0; mask &= mask - 1, bits >>= 1)
    if (bits & 1) placed |= mask & (0u - mask);
  return placed;
#endif
}

// The items that have a bit in `which`, their numbers in `buffer`.
HWY_INLINE std::span<const std::uint32_t> close_ones(const NearItems& near, const std::uint64_t* which,
                                                     std::vector<std::uint32_t>& buffer) {
  if (buffer.size() < near.count + kRoomBeyond) buffer.resize(near.count + kRoomBeyond);
  std::uint32_t* to = buffer.data();
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(which);
  static_assert(std::endian::native == std::endian::little);
  std::size_t n = 0;
  for (const Members& some : near.members) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, bytes + n / 8, sizeof bits);
    to = write_members(some.first(), deposit(bits >> n % 8, some.bits()), to);
    n += some.count();
  }
  return {buffer.data(), to};
}

template <int Dim, bool kIsotropic>
HWY_INLINE void gather_near(const LaneModel<Dim>& model, const NodeLanes<Dim>& group,
                            const ForceLanes<Dim>& lanes, std::size_t turn, const NearItems& fluid,
                            const CloseGroup& close, std::vector<std::uint32_t>& buffer,
                            const Particles<Dim>& particles, ForceSums<Dim>& sums) {
  if (fluid.lanes == nullptr)
    gather_fluid<Dim, false, kIsotropic>(model, group, lanes, turn,
                                         close_ones(fluid, close.of(turn / kLanes), buffer), nullptr,
                                         particles, sums);
  else
    gather_fluid<Dim, true, kIsotropic>(model, group, lanes, turn, write_all(fluid, buffer), fluid.lanes,
                                        particles, sums);
}

template <int Dim>
HWY_INLINE void forces(const LaneModel<Dim>& model, const NodeLanes<Dim>& group, const NearItems& fluid,
                       const CloseGroup& close, std::vector<std::uint32_t>& buffer,
                       const Particles<Dim>& particles, const NearGroup& boundary,
                       const BoundaryParticles<Dim>& walls, ForceLanes<Dim>& lanes) {
  for (std::size_t turn = 0; turn < kGroup; turn += kLanes) {
    ForceSums<Dim> sums;
    sums.clear();
    if (particles.source.empty())
      gather_near<Dim, true>(model, group, lanes, turn, fluid, close, buffer, particles, sums);
    else
      gather_near<Dim, false>(model, group, lanes, turn, fluid, close, buffer, particles, sums);
    gather_boundary<Dim>(model, group, turn, boundary, walls, sums);
    const V volume = load(group.volume, turn), W0 = set(Wendland::value_factor(model.kernel));
    const double slope = Wendland::slope_factor(model.kernel);
    const V alpha = set(model.artificial_viscosity * slope);
    const V mass = load(lanes.mass, turn);
    Vecs<Dim> acceleration;
    SLUICE_UNROLL
    for (int a = 0; a < Dim; ++a) {
      const V stress = hn::MulSub(set(model.boundary_G), sums.traction[a], sums.internal[a]);
      acceleration[a] =
          hn::MulAdd(volume, hn::MulAdd(W0, stress, alpha * sums.viscous[a]), sums.pairwise[a]) / mass;
    }
    store(acceleration, lanes.acceleration, turn);
    store(set(model.density_diffusion * slope) * sums.diffusion, lanes.density_rate, turn);
  }
}

// Fluid particle i distributes its stress to w like to any neighbour, and takes w's traction with the
// opposite sign.
template <int Dim, bool kIsotropic>
HWY_INLINE void reactions(const LaneModel<Dim>& model, const NodeLanes<Dim>& group, const NearGroup& near,
                          const Particles<Dim>& particles, ReactionLanes<Dim>& lanes) {
  const Wendland kernel(model.kernel);
  for (std::size_t turn = 0; turn < kGroup; turn += kLanes) {
    const Vecs<Dim> x = load(group.x, turn);
    const V volume = load(group.volume, turn), traction = load(lanes.pressure_volume, turn);
    M on = hn::Eq(hn::Zero(D()), hn::Zero(D()));
    Vecs<Dim> internal = zeros<Dim>(), back = zeros<Dim>(), guard = zeros<Dim>();
    for (std::size_t n = 0; n < near.index.size(); ++n) {
      const Node<Dim>& i = particles.node[near.index[n]];
      if (near.lanes != nullptr) on = lanes_of(near.lanes, n, turn);
      Vecs<Dim> x_wi;
      SLUICE_UNROLL
      for (int a = 0; a < Dim; ++a) x_wi[a] = x[a] - set(i.x[a]);
      const V r2 = dot(x_wi, x_wi);
      V W = hn::IfThenElseZero(on, kernel.value(r2));
      const V WV = W * set(i.volume);
      Vecs<Dim> flux;
      if constexpr (kIsotropic) {
        const Fit<Dim>& from = particles.fit[near.index[n]];
        flux = flux_of<Dim>(from.g, from.G, x_wi);
        W = W * set(particles.gradients[near.index[n]].V_sigma);
      } else {
        const Source<Dim>& from = particles.source[near.index[n]];
        flux = flux_of<Dim>(from.s, from.S, x_wi);
      }
      SLUICE_UNROLL
      for (int a = 0; a < Dim; ++a) {
        internal[a] = hn::MulAdd(W, flux[a], internal[a]);
        back[a] = hn::MulAdd(WV, x_wi[a], back[a]);
      }
      add_guard<Dim>(model, on, r2, x_wi, guard);
    }
    const V W0 = set(Wendland::value_factor(model.kernel)), G = set(model.boundary_G);
    Vecs<Dim> force;
    SLUICE_UNROLL
    for (int a = 0; a < Dim; ++a)
      force[a] = hn::MulAdd(W0, G * traction * back[a] - volume * internal[a], guard[a]);
    store(force, lanes.force, turn);
  }
}

void forces_2d(const LaneModel<2>& model, const NodeLanes<2>& group, const NearItems& fluid,
               const CloseGroup& close, std::vector<std::uint32_t>& buffer, const Particles<2>& particles,
               const NearGroup& boundary, const BoundaryParticles<2>& walls, ForceLanes<2>& lanes) {
  forces<2>(model, group, fluid, close, buffer, particles, boundary, walls, lanes);
}
void forces_3d(const LaneModel<3>& model, const NodeLanes<3>& group, const NearItems& fluid,
               const CloseGroup& close, std::vector<std::uint32_t>& buffer, const Particles<3>& particles,
               const NearGroup& boundary, const BoundaryParticles<3>& walls, ForceLanes<3>& lanes) {
  forces<3>(model, group, fluid, close, buffer, particles, boundary, walls, lanes);
}
void reactions_2d(const LaneModel<2>& model, const NodeLanes<2>& group, const NearGroup& fluid,
                  const Particles<2>& particles, ReactionLanes<2>& lanes) {
  if (particles.source.empty())
    reactions<2, true>(model, group, fluid, particles, lanes);
  else
    reactions<2, false>(model, group, fluid, particles, lanes);
}
void reactions_3d(const LaneModel<3>& model, const NodeLanes<3>& group, const NearGroup& fluid,
                  const Particles<3>& particles, ReactionLanes<3>& lanes) {
  if (particles.source.empty())
    reactions<3, true>(model, group, fluid, particles, lanes);
  else
    reactions<3, false>(model, group, fluid, particles, lanes);
}

}  // namespace sluice::fluid::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sluice::fluid {

HWY_EXPORT(forces_2d);
HWY_EXPORT(forces_3d);
HWY_EXPORT(reactions_2d);
HWY_EXPORT(reactions_3d);

template <>
void gather_forces(const LaneModel<2>& model, const NodeLanes<2>& group, const NearItems& fluid,
                   const CloseGroup& close, std::vector<std::uint32_t>& buffer, const Particles<2>& particles,
                   const NearGroup& boundary, const BoundaryParticles<2>& walls, ForceLanes<2>& lanes) {
  HWY_DYNAMIC_DISPATCH(forces_2d)(model, group, fluid, close, buffer, particles, boundary, walls, lanes);
}
template <>
void gather_forces(const LaneModel<3>& model, const NodeLanes<3>& group, const NearItems& fluid,
                   const CloseGroup& close, std::vector<std::uint32_t>& buffer, const Particles<3>& particles,
                   const NearGroup& boundary, const BoundaryParticles<3>& walls, ForceLanes<3>& lanes) {
  HWY_DYNAMIC_DISPATCH(forces_3d)(model, group, fluid, close, buffer, particles, boundary, walls, lanes);
}
template <>
void gather_reaction(const LaneModel<2>& model, const NodeLanes<2>& group, const NearGroup& fluid,
                     const Particles<2>& particles, ReactionLanes<2>& lanes) {
  HWY_DYNAMIC_DISPATCH(reactions_2d)(model, group, fluid, particles, lanes);
}
template <>
void gather_reaction(const LaneModel<3>& model, const NodeLanes<3>& group, const NearGroup& fluid,
                     const Particles<3>& particles, ReactionLanes<3>& lanes) {
  HWY_DYNAMIC_DISPATCH(reactions_3d)(model, group, fluid, particles, lanes);
}

}  // namespace sluice::fluid
#endif
