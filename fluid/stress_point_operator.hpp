#pragma once

#include <array>
#include <cmath>

#include "fluid/equation_of_state.hpp"
#include "fluid/mls_operators.hpp"

namespace sluice::fluid {

// Stress points of a particle, from it [m]: the middles of the quarters or eighths of its cube.
template <int Dim>
std::array<Vec<Dim>, Particles<Dim>::kPoints> stress_points(double spacing) {
  std::array<Vec<Dim>, Particles<Dim>::kPoints> points;
  for (std::size_t s = 0; s < points.size(); ++s)
    for (int a = 0; a < Dim; ++a) points[s][a] = ((s >> a) % 2 == 1 ? 0.25 : -0.25) * spacing;
  return points;
}

// Quadrature with stress points instead of the particles, CF (46) and (54), fig. 4: 2^Dim of them in the cube
// of edge dx around each particle, a quarter of dx from its centre along every axis, with equal shares of its
// volume.
//   f_i = -sum_k sum_s V_k/2^Dim sigma_s grad N_i(x_s),   grad N_i(x_s) = V_i W (g_s + G_s x_is).
// They move with their particle, so that the cube keeps its shape; the paper moves them by (48) where the
// flow distorts it. Density is interpolated to them, CF (49), its difference to the particle's being that of
// the last step; the viscous stress is the particle's. Boundary particles stay quadrature points themselves.
// Cost: both sweeps have 2^Dim times the kernels.
template <int Dim>
struct StressPoints : DiffuseMls<Dim> {
  static constexpr bool kIsDefault = false, kHasPoints = true;
  static constexpr std::size_t kPoints = Particles<Dim>::kPoints;
  struct Point {
    Vec<Dim> g = Vec<Dim>::Zero();
    Mat<Dim> G = Mat<Dim>::Zero();
    double difference = 0;  // of the density to the particle's [kg/m^3]
    bool floored = false;
  };
  using Coefficients = std::array<Point, kPoints>;

  static double extra_reach(double spacing) { return 0.25 * std::sqrt(static_cast<double>(Dim)) * spacing; }

  static void set_source(const EquationOfState& eos, double volume, const Mat<Dim>& sigma,
                         const Coefficients& points, Particles<Dim>& fluid, std::size_t i) {
    const double share = volume / static_cast<double>(kPoints);
    for (std::size_t s = 0; s < kPoints; ++s) {
      const double p = eos.pressure(fluid.node[i].rho + points[s].difference);
      // As in spray, a shear stress would exert a moment where G is not the exact inverse.
      Mat<Dim> sigma_s = -p * Mat<Dim>::Identity();
      if (!points[s].floored) sigma_s += sigma + fluid.pressure[i] * Mat<Dim>::Identity();
      fluid.point_source[kPoints * i + s] = {share * (sigma_s * points[s].g),
                                             share * (sigma_s * points[s].G)};
    }
  }

  // At x from particle k, which may be k itself: sum_s V_s sigma_s grad N_i(x_s)/V_i.
  template <typename Model>
  static Vec<Dim> point_flux(const Model& model, const Particles<Dim>& fluid, std::size_t k,
                             const Vec<Dim>& x) {
    Vec<Dim> sum = Vec<Dim>::Zero();
    for (std::size_t s = 0; s < kPoints; ++s) {
      const Vec<Dim> x_s = x - model.points[s];
      const PointSource<Dim>& from = fluid.point_source[kPoints * k + s];
      sum += model.kernel.value(x_s) * (from.s + from.S * x_s);
    }
    return sum;
  }
};

}  // namespace sluice::fluid
