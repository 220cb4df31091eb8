#pragma once

#include <span>
#include <vector>

#include "fluid/force_sweep.hpp"
#include "fluid/gradient_sweep.hpp"

namespace sluice::fluid {

// Of CF (43), the force of i and k on each other is p_k A_ik - p_i A_ki with A_ik = V_i V_k W (g_k + G_k
// x_ik), written in pairs by sum grad N = 0. Between two liquids the mean of p_i and p_k is biased
// (liquids.hpp), which adds
//   theta (p_i - p_k) b_ik,   b_ik = (A_ik - A_ki)/2 along x_ik,
// to the force on i and its opposite to that on k; and, so that the work of the pressures stays the energy of
// compression, to V_i div v at i
//   theta (v_i - v_k) . b_ik.
// Deviation from A_ik - A_ki: its part across x_ik is left out, which would exert a moment. A constant
// pressure gives no force of this kind, and on a lattice it vanishes between particles of one velocity.
template <int Dim, typename Kernel>
Vec<Dim> pair_area(const Model<Dim, Kernel>& model, const Particles<Dim>& fluid, std::size_t i, std::size_t k,
                   const Vec<Dim>& x_ik) {
  const double r2 = x_ik.squaredNorm() + model.tiny_r2;
  const Fit<Dim>&at_i = fluid.fit[i], &at_k = fluid.fit[k];
  const double along = x_ik.dot((at_k.g - at_i.g) + (at_i.G + at_k.G) * x_ik) / r2;
  return 0.5 * fluid.node[i].volume * fluid.node[k].volume * model.kernel.value(x_ik) * along * x_ik;
}

// Sweep 2 with several liquids: as ForceSweep, but
// - between liquids the pressure is biased, and no density diffuses;
// - the viscous stress of a liquid acts on itself alone, through the fit of its own particles; between
//   liquids the pairwise viscosity of their laminar ones is the friction. Artificial viscosity there would be
//   friction of liquids without any: it took a fifth of an interfacial wave's amplitude in two periods.
template <int Dim, typename Kernel>
class LiquidForceSweep {
 public:
  LiquidForceSweep(const Model<Dim, Kernel>& model, const Particles<Dim>& fluid, std::size_t i)
      : model_(model),
        fluid_(fluid),
        i_(i),
        node_(fluid.node[i]),
        flow_(fluid.gradients[i]),
        liquid_(fluid.liquid_of(i)) {
    internal_ = model.kernel.at_zero() * (fluid.source[i].s + fluid.own[i].s);
  }

  void gather_fluid(std::span<const std::uint32_t> neighbors) {
    for (const std::uint32_t k : neighbors) add_fluid(k);
  }

  void gather_boundary(std::span<const std::uint32_t> neighbors, const BoundaryParticles<Dim>& boundary) {
    for (const std::uint32_t w : neighbors) {
      const Vec<Dim> x_iw = node_.x - boundary.node()[w].x;
      const ValueAndSlope weight = Operator<Dim, Kernel>::weight(model_.kernel, x_iw);
      pair_ += boundary_traction(model_, boundary, w, fluid_, i_, weight, x_iw) +
               returned_traction(boundary, w, weight.w, x_iw) + guard_force(model_, x_iw);
    }
  }

  [[nodiscard]] Vec<Dim> force() const { return pair_ - node_.volume * internal_; }
  [[nodiscard]] double density_rate() const { return liquid_.density_diffusion * diffusion_; }

 private:
  void add_fluid(std::size_t k) {
    const Node<Dim>& node = fluid_.node[k];
    const Source<Dim>& from = fluid_.source[k];
    const FlowGradients<Dim>& flow = fluid_.gradients[k];
    const Vec<Dim> x_ik = node_.x - node.x;
    const double r2 = x_ik.squaredNorm();
    const auto [W, F] = model_.kernel.value_and_slope(x_ik);
    internal_ += W * (from.s + from.S * x_ik);

    const double VF = node.volume * F;
    if (fluid_.liquid[k] != fluid_.liquid[i_]) return add_other(k, x_ik, r2, VF);
    internal_ += W * (fluid_.own[k].s + fluid_.own[k].S * x_ik);
    pair_ += liquid_.pair_viscosity * damping(k, x_ik, r2, VF);
    diffusion_ += VF * (node.rho - node_.rho + (flow_.half_grad_rho + flow.half_grad_rho).dot(x_ik));
  }

  void add_other(std::size_t k, const Vec<Dim>& x_ik, double r2, double VF) {
    const LiquidConstants& other = fluid_.liquid_of(k);
    pair_ += pressure_bias(liquid_, other) * (fluid_.pressure[i_] - fluid_.pressure[k]) *
                 pair_area(model_, fluid_, i_, k, x_ik) +
             mean_friction(liquid_, other) * damping(k, x_ik, r2, VF);
  }

  // Of the artificial viscosity, over its coefficient (force_sweep.hpp).
  [[nodiscard]] Vec<Dim> damping(std::size_t k, const Vec<Dim>& x_ik, double r2, double VF) const {
    const double unexplained = (node_.v - fluid_.node[k].v).dot(x_ik) -
                               x_ik.dot((flow_.half_strain + fluid_.gradients[k].half_strain) * x_ik);
    return -node_.volume * VF * unexplained / (r2 + model_.tiny_r2) * x_ik;
  }

  const Model<Dim, Kernel>& model_;
  const Particles<Dim>& fluid_;
  std::size_t i_;
  const Node<Dim>& node_;
  const FlowGradients<Dim>& flow_;
  const LiquidConstants& liquid_;
  Vec<Dim> internal_ = Vec<Dim>::Zero();
  Vec<Dim> pair_ = Vec<Dim>::Zero();
  double diffusion_ = 0;
};

}  // namespace sluice::fluid
