#include "fluid/lanes.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "fluid/boundary_lanes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "fluid/lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace sluice::fluid::HWY_NAMESPACE {

// W of a neighbour and the moments of W; extrapolation.hpp.
template <int Dim>
struct MomentSums {
  V m0;
  Vecs<Dim> m1;
  Vecs<Dim*(Dim + 1) / 2> m2;

  HWY_INLINE void clear() {
    m0 = hn::Zero(D());
    m1 = zeros<Dim>();
    m2 = zeros<Dim*(Dim + 1) / 2>();
  }

  HWY_INLINE void add(V W, const Vecs<Dim>& Wx, const Vecs<Dim>& x) {
    m0 = m0 + W;
    SLUICE_UNROLL
    for (int a = 0; a < Dim; ++a) m1[a] = m1[a] + Wx[a];
    SLUICE_UNROLL
    for (int ab = 0; ab < Dim * Dim; ++ab) {
      const int a = ab / Dim, b = ab % Dim;
      if (a <= b) m2[sym<Dim>(a, b)] = hn::MulAdd(Wx[a], x[b], m2[sym<Dim>(a, b)]);
    }
  }
};

template <int Dim>
HWY_INLINE V weight(const Wendland& kernel, const NearGroup& near, std::size_t n, std::size_t turn, V r2) {
  const V W = kernel.value(r2);  // but for its constant: only ratios of the sums are used
  return near.lanes == nullptr ? W : hn::IfThenElseZero(lanes_of(near.lanes, n, turn), W);
}

template <int Dim>
HWY_INLINE void flows(const LaneModel<Dim>& model, const NodeLanes<Dim>& group, const NearNodes<Dim>& fluid,
                      FlowLanes<Dim>& lanes) {
  const Wendland kernel(model.kernel);
  for (std::size_t turn = 0; turn < kGroup; turn += kLanes) {
    const Vecs<Dim> x = load(group.x, turn), body = load(lanes.body_velocity, turn);
    MomentSums<Dim> moments;
    moments.clear();
    Vecs<Dim> v = zeros<Dim>();
    Vecs<Dim* Dim> vx = zeros<Dim * Dim>();
    for (std::size_t n = 0; n < fluid.near.index.size(); ++n) {
      const Node<Dim>& f = fluid.node[fluid.near.index[n]];
      Vecs<Dim> x_fw, Wx, v_f;
      SLUICE_UNROLL
      for (int a = 0; a < Dim; ++a) x_fw[a] = set(f.x[a]) - x[a];
      const V W = weight<Dim>(kernel, fluid.near, n, turn, dot(x_fw, x_fw));
      SLUICE_UNROLL
      for (int a = 0; a < Dim; ++a) {
        Wx[a] = W * x_fw[a];
        v_f[a] = set(f.v[a]) - body[a];
        v[a] = hn::MulAdd(W, v_f[a], v[a]);
      }
      moments.add(W, Wx, x_fw);
      SLUICE_UNROLL
      for (int ab = 0; ab < Dim * Dim; ++ab) vx[ab] = hn::MulAdd(v_f[ab / Dim], Wx[ab % Dim], vx[ab]);
    }
    store(moments.m0, lanes.m0, turn);
    store(moments.m1, lanes.m1, turn);
    store(moments.m2, lanes.m2, turn);
    store(v, lanes.v, turn);
    store(vx, lanes.vx, turn);
  }
}

template <int Dim>
HWY_INLINE void states(const LaneModel<Dim>& model, const NodeLanes<Dim>& group, const NearGroup& near,
                       const Particles<Dim>& particles, StateLanes<Dim>& lanes) {
  const Wendland kernel(model.kernel);
  const V per_c2 = set(1.0 / (model.eos.sound_speed() * model.eos.sound_speed()));
  const V tiny_r2 = set(model.tiny_r2), zero = hn::Zero(D());
  for (std::size_t turn = 0; turn < kGroup; turn += kLanes) {
    const Vecs<Dim> x = load(group.x, turn), body = load(lanes.body_velocity, turn);
    const Vecs<Dim> pull = load(lanes.pull, turn);
    MomentSums<Dim> moments;
    moments.clear();
    V p = zero, rho = zero, volume = zero, dynamic = zero, fitted = zero;
    Vecs<Dim> px = zeros<Dim>(), rhox = zeros<Dim>(), g = zeros<Dim>();
    for (std::size_t n = 0; n < near.index.size(); ++n) {
      const std::uint32_t index = near.index[n];
      const Node<Dim>& f = particles.node[index];
      Vecs<Dim> x_fw, Wx, toward;
      SLUICE_UNROLL
      for (int a = 0; a < Dim; ++a) {
        x_fw[a] = set(f.x[a]) - x[a];
        toward[a] = body[a] - set(f.v[a]);
      }
      const V r2 = dot(x_fw, x_fw), rho_f = set(f.rho);
      const V W = weight<Dim>(kernel, near, n, turn, r2);
      const V dp = hn::Neg(rho_f) * dot(pull, x_fw);
      const Fit<Dim>& fit = particles.fit[index];
      V p_f = zero;
      if (!fit.floored) {
        p_f = set(particles.pressure[index]) + dp;
        fitted = fitted + W;
        SLUICE_UNROLL
        for (int a = 0; a < Dim; ++a) g[a] = hn::MulAdd(W, set(fit.g[a]), g[a]);
      }
      const V rho_w = hn::MulAdd(dp, per_c2, rho_f);
      const V approach = hn::Max(zero, dot(toward, x_fw));
      p = hn::MulAdd(W, p_f, p);
      rho = hn::MulAdd(W, rho_w, rho);
      volume = hn::MulAdd(W, set(f.volume), volume);
      dynamic = hn::MulAdd(W * set(0.5) * rho_f, approach * approach / (r2 + tiny_r2), dynamic);
      SLUICE_UNROLL
      for (int a = 0; a < Dim; ++a) {
        Wx[a] = W * x_fw[a];
        px[a] = hn::MulAdd(p_f, Wx[a], px[a]);
        rhox[a] = hn::MulAdd(rho_w, Wx[a], rhox[a]);
      }
      moments.add(W, Wx, x_fw);
    }
    store(moments.m0, lanes.m0, turn);
    store(moments.m1, lanes.m1, turn);
    store(moments.m2, lanes.m2, turn);
    store(p, lanes.p, turn);
    store(rho, lanes.rho, turn);
    store(volume, lanes.volume, turn);
    store(dynamic, lanes.dynamic, turn);
    store(fitted, lanes.fitted, turn);
    store(g, lanes.g, turn);
    store(px, lanes.px, turn);
    store(rhox, lanes.rhox, turn);
  }
}

void flows_2d(const LaneModel<2>& model, const NodeLanes<2>& group, const NearNodes<2>& fluid,
              FlowLanes<2>& lanes) {
  flows<2>(model, group, fluid, lanes);
}
void flows_3d(const LaneModel<3>& model, const NodeLanes<3>& group, const NearNodes<3>& fluid,
              FlowLanes<3>& lanes) {
  flows<3>(model, group, fluid, lanes);
}
void states_2d(const LaneModel<2>& model, const NodeLanes<2>& group, const NearGroup& fluid,
               const Particles<2>& particles, StateLanes<2>& lanes) {
  states<2>(model, group, fluid, particles, lanes);
}
void states_3d(const LaneModel<3>& model, const NodeLanes<3>& group, const NearGroup& fluid,
               const Particles<3>& particles, StateLanes<3>& lanes) {
  states<3>(model, group, fluid, particles, lanes);
}

}  // namespace sluice::fluid::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sluice::fluid {

HWY_EXPORT(flows_2d);
HWY_EXPORT(flows_3d);
HWY_EXPORT(states_2d);
HWY_EXPORT(states_3d);

template <>
void gather_flow(const LaneModel<2>& model, const NodeLanes<2>& group, const NearNodes<2>& fluid,
                 FlowLanes<2>& lanes) {
  HWY_DYNAMIC_DISPATCH(flows_2d)(model, group, fluid, lanes);
}
template <>
void gather_flow(const LaneModel<3>& model, const NodeLanes<3>& group, const NearNodes<3>& fluid,
                 FlowLanes<3>& lanes) {
  HWY_DYNAMIC_DISPATCH(flows_3d)(model, group, fluid, lanes);
}
template <>
void gather_state(const LaneModel<2>& model, const NodeLanes<2>& group, const NearGroup& fluid,
                  const Particles<2>& particles, StateLanes<2>& lanes) {
  HWY_DYNAMIC_DISPATCH(states_2d)(model, group, fluid, particles, lanes);
}
template <>
void gather_state(const LaneModel<3>& model, const NodeLanes<3>& group, const NearGroup& fluid,
                  const Particles<3>& particles, StateLanes<3>& lanes) {
  HWY_DYNAMIC_DISPATCH(states_3d)(model, group, fluid, particles, lanes);
}

}  // namespace sluice::fluid
#endif
