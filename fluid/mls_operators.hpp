#pragma once

#include <array>

#include "fluid/sph_operators.hpp"

namespace sluice::fluid {

// Where kHasSumOne, the shape functions N_j(x_i) = V_j W (a + b.x_ji) themselves follow from the fit.
template <int Dim>
struct ShapeFunction {
  double a;
  Vec<Dim> b;
};

template <int Dim>
struct CubicMoments : SlopeMoments<Dim> {
  std::array<Mat<Dim>, Dim> n3{};

  CubicMoments() { n3.fill(Mat<Dim>::Zero()); }
  void add(double VW, double VF, const Vec<Dim>& x_ji) {
    SlopeMoments<Dim>::add(VW, VF, x_ji);
    const Mat<Dim> square = VF * x_ji * x_ji.transpose();
    for (int a = 0; a < Dim; ++a) n3[static_cast<std::size_t>(a)] += x_ji[a] * square;
  }
};

// Derivative of the local fit, the default: grad N_j = V_j W (g + G x_ji).
template <int Dim>
struct DiffuseMls {
  static constexpr bool kIsDefault = true, kIsIsobaric = false, kHasSumOne = true, kHasPoints = false;
  struct Coefficients {};

  static ShapeFunction<Dim> shape_function(const Fit<Dim>& fit) { return {shape_constant(fit), fit.g}; }

  template <typename Kernel>
  static ValueAndSlope weight(const Kernel& kernel, const Vec<Dim>& x) {
    return {kernel.value(x), 0.0};
  }
  // W of a boundary particle as a quadrature point; Model::boundary_G goes with it.
  static double lattice_weight(const ValueAndSlope& weight) { return weight.w; }
  static double lattice_G(double lattice_moment, double) { return 1.0 / lattice_moment; }
  // How much farther than the support two particles may be to act on each other [m].
  static double extra_reach(double) { return 0.0; }

  static Vec<Dim> flux(const Particles<Dim>& fluid, std::size_t k, const ValueAndSlope& weight,
                       const Vec<Dim>& x) {
    return weight.w * (fluid.source[k].s + fluid.source[k].S * x);
  }
  static Vec<Dim> own_flux(const Source<Dim>& source, double W0) { return W0 * source.s; }
};

// Moving least squares with the constant basis, N_j = V_j W/m0, differentiated in full:
//   grad N_j = V_j (F x_ji/m0 - W n1/m0^2).
// Exact for constants only. Under pressure it exerts a net moment where n1 is not zero.
template <int Dim>
struct Shepard : Sph<Dim> {
  static constexpr bool kHasSumOne = true;
  struct Coefficients {
    double a = 0;                   // 1/m0
    Vec<Dim> c = Vec<Dim>::Zero();  // -n1/m0^2
  };

  static ShapeFunction<Dim> shape_function(const Fit<Dim>& fit) { return {1.0 / fit.m0, Vec<Dim>::Zero()}; }
  static Coefficients coefficients(const SlopeMoments<Dim>& sums, const Fit<Dim>&, double) {
    const double a = 1.0 / sums.fit.m0;
    return {a, -a * a * sums.n1};
  }
  static Vec<Dim> gradient(const Coefficients& c, const ValueAndSlope& weight, const Vec<Dim>& x_ji) {
    return weight.f * c.a * x_ji + weight.w * c.c;
  }
  static void set_source(double volume, const Mat<Dim>& sigma, const Coefficients& c, Particles<Dim>& fluid,
                         std::size_t i) {
    Source<Dim>& source = fluid.source[i];
    source.s = volume * (sigma * c.c);
    source.S = volume * c.a * sigma;
  }
  static Vec<Dim> flux(const Particles<Dim>& fluid, std::size_t k, const ValueAndSlope& weight,
                       const Vec<Dim>& x) {
    return weight.w * fluid.source[k].s + weight.f * (fluid.source[k].S * x);
  }
  static Vec<Dim> own_flux(const Source<Dim>& source, double W0) { return W0 * source.s; }
};

// Moving least squares with the linear basis, CF (15), differentiated in full. From N_j = V_j W (a + b.x_ji),
// b = -G m1/m0 and a = (1 - m1.b)/m0:
//   grad N_j = V_j [F x_ji (a + b.x_ji) + W (c + D x_ji)],   c = grad a - b,   D = grad b (row: derivative),
// with d_p m0 = n1_p,  d_p m1 = n2_p - m0 e_p,  d_p m2 = n3_p - m1 (x) e_p - e_p (x) m1,  d_p G = -G d_p C G.
// Where the fit is floored (spray) it falls back to the derivative of the fit, a = b = 0, c = g, D = G.
template <int Dim>
struct FullMls : Sph<Dim> {
  static constexpr bool kHasSumOne = true;
  using Sums = CubicMoments<Dim>;
  struct Coefficients {
    double a = 0;
    Vec<Dim> b = Vec<Dim>::Zero(), c = Vec<Dim>::Zero();
    Mat<Dim> D = Mat<Dim>::Zero();
  };

  static ShapeFunction<Dim> shape_function(const Fit<Dim>& fit) { return {shape_constant(fit), fit.g}; }
  static Coefficients coefficients(const Sums& sums, const Fit<Dim>& fit, double) {
    Coefficients k;
    if (fit.floored) {
      k.c = fit.g;
      k.D = fit.G;
      return k;
    }
    const double m0 = sums.fit.m0;
    const Vec<Dim>& m1 = sums.fit.m1;
    k.b = fit.g;
    k.a = (1.0 - m1.dot(k.b)) / m0;
    for (int p = 0; p < Dim; ++p) {
      const Vec<Dim> e = Vec<Dim>::Unit(p);
      const double dm0 = sums.n1[p];
      const Vec<Dim> dm1 = sums.n2.col(p) - m0 * e;
      const Mat<Dim> dm2 = sums.n3[static_cast<std::size_t>(p)] - m1 * e.transpose() - e * m1.transpose();
      const Mat<Dim> dC =
          dm2 - (dm1 * m1.transpose() + m1 * dm1.transpose()) / m0 + dm0 / (m0 * m0) * m1 * m1.transpose();
      const Vec<Dim> db = fit.G * (dC * (fit.G * m1) - dm1 + dm0 / m0 * m1) / m0;
      k.D.row(p) = db;
      k.c[p] = -(dm1.dot(k.b) + m1.dot(db)) / m0 - k.a * dm0 / m0 - k.b[p];
    }
    return k;
  }
  static Vec<Dim> gradient(const Coefficients& k, const ValueAndSlope& weight, const Vec<Dim>& x_ji) {
    return weight.f * (k.a + k.b.dot(x_ji)) * x_ji + weight.w * (k.c + k.D * x_ji);
  }
  static void set_source(double volume, const Mat<Dim>& sigma, const Coefficients& k, Particles<Dim>& fluid,
                         std::size_t i) {
    fluid.source[i].s = volume * (sigma * k.c);
    fluid.source[i].S = volume * (sigma * k.D);
    fluid.slope_source[i] = {volume * sigma, k.a, k.b};
  }
  static Vec<Dim> flux(const Particles<Dim>& fluid, std::size_t k, const ValueAndSlope& weight,
                       const Vec<Dim>& x) {
    const SlopeSource<Dim>& slope = fluid.slope_source[k];
    return weight.w * (fluid.source[k].s + fluid.source[k].S * x) +
           weight.f * (slope.a + slope.b.dot(x)) * (slope.sigma_V * x);
  }
  static Vec<Dim> own_flux(const Source<Dim>& source, double W0) { return W0 * source.s; }
  static double lattice_G(double, double lattice_slope) { return 1.0 / lattice_slope; }
};

}  // namespace sluice::fluid
