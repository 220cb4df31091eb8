#pragma once

#include <algorithm>
#include <span>

#include "fluid/boundary.hpp"
#include "fluid/extrapolation.hpp"
#include "fluid/model.hpp"

namespace sluice::fluid {

// Share (0 to 1) of a boundary particle that takes part, from the head that the fluid near it has there:
// static pressure plus the dynamic pressure of fluid that approaches. Where the head is negative the fluid
// does not reach the wall, e.g. above the waterline; a dry boundary particle must not stand in for liquid, or
// the contact line creeps. The ramp is half a spacing of static head wide, and never narrower than a
// millionth of rho0 c0^2.
template <int Dim, typename Kernel>
double wetness(const Model<Dim, Kernel>& model, double head, double acceleration, double relative_density) {
  const double c0 = model.eos.sound_speed();
  const double scale =
      relative_density * model.eos.rest_density() * (acceleration * model.spacing + 1e-6 * c0 * c0);
  return std::clamp(0.5 + 2.0 * head / scale, 0.0, 1.0);
}

// The viscous stress at boundary particle w. Past a no-slip surface it goes on linearly; along a surface on
// which the fluid slides there is no shear, and the mirror image has its sign changed.
template <int Dim, typename Kernel>
Mat<Dim> boundary_stress(const Model<Dim, Kernel>& model, const Particles<Dim>& fluid,
                         std::span<const std::uint32_t> neighbors, std::size_t w,
                         const BoundaryParticles<Dim>& boundary) {
  using Flat = Eigen::Matrix<double, Dim * Dim, 1>;
  Extrapolation<Dim, Dim * Dim> stress;
  for (const std::uint32_t f : neighbors) {
    const Vec<Dim> x_fw = fluid.node[f].x - boundary.node()[w].x;
    stress.add(model.kernel.value(x_fw), x_fw, fluid.stress[f].reshaped());
  }
  if (boundary.no_slip(w)) {
    const Flat at_w = stress.mean() - stress.slope(model.moment_floor) * stress.centroid();
    return at_w.template reshaped<Eigen::ColMajor>(Dim, Dim);
  }
  const Mat<Dim> mean = Flat(stress.mean()).template reshaped<Eigen::ColMajor>(Dim, Dim);
  const Mat<Dim> reflection = Mat<Dim>::Identity() - 2.0 * boundary.surface(w).across;
  return reflection * mean * reflection;
}

// Share of boundary particle w that is in an impact. There, the pressure is that of many rows of liquid at
// rest, row [Pa] each, and the fluid is one-sided: g, which is near -G m1/m0, is not small against G h. In
// liquid at rest one of both is: deep down the neighbours stand all around, and the surface bears no
// pressure.
inline constexpr double kRowsOfImpact = 2.0, kOneSided = 0.02;
inline double impact(double pressure, double row, double one_sided) {
  const auto ramp = [](double value, double from) { return std::clamp(value / from - 1.0, 0.0, 1.0); };
  if (!(pressure > 0.0)) return 0.0;
  return ramp(one_sided, kOneSided) * (row > 0.0 ? ramp(pressure / row, kRowsOfImpact) : 1.0);
}

// Sums over the fluid f near a boundary particle w:
//   W (p_f + dp) and W (rho_f + dp/c0^2),   dp = rho_f (g - a_w) . n n . x_wf the hydrostatic continuation,
//   W V_f,   W rho_f u^2/2 with u the speed of approach;   with several liquids W times the relative density;
//   W g and W of those whose fit is not floored.
template <int Dim>
struct NearState {
  Extrapolation<Dim, 2> state;  // pressure and density
  double volume = 0, dynamic = 0, relative_density = 0;
  Vec<Dim> g = Vec<Dim>::Zero();
  double fitted = 0;
};

// (g - a_w) . n n [m/s^2], across the surface.
template <int Dim, typename Kernel>
Vec<Dim> pull_across(const Model<Dim, Kernel>& model, const BoundaryParticles<Dim>& boundary, std::size_t w) {
  return boundary.surface(w).across * (model.gravity - boundary.acceleration(w));
}

// What a boundary particle w takes over from the fluid: pressure and density, continued along the surface and
// with the hydrostatic gradient in the boundary's own frame across it (after S. Adami, X. Hu, N. Adams,
// J. Comput. Phys. 231, 2012, eq. 27, where the gradient along the surface is hydrostatic too),
//   p_w = sum_f (p_f + rho_f (g - a_w) . n n . x_wf) W_wf / sum_f W_wf + slope . (x_wf)_along,
// rho_w alike with dp/c0^2; and volume ratio, averaged. Tension is not passed on: a wall does not hold the
// fluid. Returns the wetness.
template <int Dim, typename Kernel>
double take_over(const Model<Dim, Kernel>& model, const NearState<Dim>& near, std::size_t w,
                 BoundaryParticles<Dim>& boundary) {
  Node<Dim>& node = boundary.node()[w];
  const Extrapolation<Dim, 2>& state = near.state;
  if (state.empty()) {
    boundary.pressure[w] = 0.0;
    boundary.dilation[w] = 1.0;
    boundary.impact[w] = boundary.one_sided[w] = 0.0;
    node.rho = model.eos.rest_density();
    return 0.0;
  }
  const double per_W = 1.0 / state.weight();
  const Vec<Dim> along = state.centroid() - boundary.surface(w).across * state.centroid();
  const Eigen::Vector2d at_w = state.mean() - state.slope(model.moment_floor) * along;
  const double acceleration = (model.gravity - boundary.acceleration(w)).norm();
  const double relative_density = near.relative_density > 0.0 ? near.relative_density * per_W : 1.0;
  const double wet = wetness(model, at_w[0] + near.dynamic * per_W, acceleration, relative_density);
  boundary.pressure[w] = wet * std::max(0.0, at_w[0]);
  boundary.dilation[w] = wet * near.volume * per_W / model.first_volume;
  node.rho = at_w[1];
  boundary.one_sided[w] =
      near.fitted > 0.0 ? near.g.norm() / (near.fitted * model.boundary_G * model.h) : 0.0;
  const double row = relative_density * node.rho * acceleration * model.spacing;
  boundary.impact[w] = impact(boundary.pressure[w], row, boundary.one_sided[w]);
  return wet;
}

// The same from the fluid particles near, with the viscous stress.
template <int Dim, typename Kernel>
void extrapolate(const Model<Dim, Kernel>& model, const Particles<Dim>& fluid,
                 std::span<const std::uint32_t> neighbors, std::size_t w, BoundaryParticles<Dim>& boundary) {
  const Vec<Dim> pull = pull_across(model, boundary, w);
  const double per_c2 = 1.0 / (model.eos.sound_speed() * model.eos.sound_speed());
  const bool several = fluid.has_several_liquids();
  NearState<Dim> near;
  for (const std::uint32_t f : neighbors) {
    const Node<Dim>& n = fluid.node[f];
    const Vec<Dim> x_fw = n.x - boundary.node()[w].x;
    const double r2 = x_fw.squaredNorm();
    const double W = model.kernel.value(x_fw);
    double rho = n.rho;
    if (several) {
      const double relative_density = fluid.liquid_of(f).relative_density;
      rho *= relative_density;
      near.relative_density += W * relative_density;
    }
    const double dp = -rho * pull.dot(x_fw);
    const double approach = std::max(0.0, (boundary.velocity(w) - n.v).dot(x_fw));
    const Fit<Dim>& fit = fluid.fit[f];
    near.state.add(W, x_fw, {fit.floored ? 0.0 : fluid.pressure[f] + dp, n.rho + dp * per_c2});
    if (!fit.floored) {
      near.g += W * fit.g;
      near.fitted += W;
    }
    near.volume += W * n.volume;
    near.dynamic += W * 0.5 * rho * approach * approach / (r2 + model.tiny_r2);
  }
  const double wet = take_over(model, near, w, boundary);
  if (boundary.stress.empty()) return;
  boundary.stress[w] = near.state.empty()
                           ? Mat<Dim>(Mat<Dim>::Zero())
                           : Mat<Dim>(wet * boundary_stress(model, fluid, neighbors, w, boundary));
}

}  // namespace sluice::fluid
