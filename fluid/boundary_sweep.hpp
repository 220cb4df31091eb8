#pragma once

#include <algorithm>
#include <span>

#include "fluid/boundary.hpp"
#include "fluid/model.hpp"

namespace sluice::fluid {

// Share (0 to 1) of a boundary particle that takes part, from the head that the fluid near it has there:
// static pressure plus the dynamic pressure of fluid that approaches. Where the head is negative the fluid
// does not reach the wall, e.g. above the waterline; a dry boundary particle must not stand in for liquid, or
// the contact line creeps. The ramp is half a spacing of static head wide, and never narrower than a
// millionth of rho0 c0^2.
template <int Dim>
double wetness(const Model<Dim>& model, double head, double acceleration) {
  const double c0 = model.eos.sound_speed();
  const double scale = model.eos.rest_density() * (acceleration * model.spacing + 1e-6 * c0 * c0);
  return std::clamp(0.5 + 2.0 * head / scale, 0.0, 1.0);
}

// What a boundary particle w takes over from the fluid: pressure and density, extrapolated with the
// hydrostatic gradient in the boundary's own frame (S. Adami, X. Hu, N. Adams, J. Comput. Phys. 231, 2012,
// eq. 27),
//   p_w = sum_f (p_f + rho_f (g - a_w) . x_wf) W_wf / sum_f W_wf,     rho_w alike with dp/c0^2,
// and volume ratio and viscous stress, averaged alike. Tension is not passed on: a wall does not hold the
// fluid.
template <int Dim>
void extrapolate(const Model<Dim>& model, const Particles<Dim>& fluid,
                 std::span<const std::uint32_t> neighbors, std::size_t w, BoundaryParticles<Dim>& boundary) {
  Node<Dim>& node = boundary.node()[w];
  const Vec<Dim> g_minus_a = model.gravity - boundary.acceleration(w);
  const double per_c2 = 1.0 / (model.eos.sound_speed() * model.eos.sound_speed());
  double sum_W = 0, sum_p = 0, sum_rho = 0, sum_V = 0, sum_dynamic = 0;
  Mat<Dim> sum_stress = Mat<Dim>::Zero();
  for (const std::uint32_t f : neighbors) {
    const Node<Dim>& n = fluid.node[f];
    const Vec<Dim> x_wf = node.x - n.x;
    const double r2 = x_wf.squaredNorm();
    const double W = model.kernel.value(r2);
    const double dp = n.rho * g_minus_a.dot(x_wf);
    const double approach = std::max(0.0, (n.v - node.v).dot(x_wf));
    sum_W += W;
    if (!fluid.fit[f].floored) sum_p += W * (fluid.pressure[f] + dp);
    sum_rho += W * (n.rho + dp * per_c2);
    sum_V += W * n.volume;
    sum_dynamic += W * 0.5 * n.rho * approach * approach / (r2 + model.tiny_r2);
    if (!fluid.stress.empty()) sum_stress += W * fluid.stress[f];
  }
  const bool has_fluid = sum_W > 0.0;
  const double wet = has_fluid ? wetness(model, (sum_p + sum_dynamic) / sum_W, g_minus_a.norm()) : 0.0;
  boundary.pressure[w] = has_fluid ? wet * std::max(0.0, sum_p / sum_W) : 0.0;
  boundary.dilation[w] = has_fluid ? wet * sum_V / (sum_W * model.first_volume) : 1.0;
  node.rho = has_fluid ? sum_rho / sum_W : model.eos.rest_density();
  if (!boundary.stress.empty())
    boundary.stress[w] = has_fluid ? Mat<Dim>(wet * sum_stress / sum_W) : Mat<Dim>::Zero();
}

}  // namespace sluice::fluid
