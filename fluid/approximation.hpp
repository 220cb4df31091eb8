#pragma once

#include <array>

#include "fluid/equation_of_state.hpp"
#include "fluid/kernel.hpp"
#include "fluid/moments.hpp"
#include "fluid/particles.hpp"

namespace sluice::fluid {

// How the derivative of a shape function follows from the kernel. An operator is a class with
//   Coefficients   what sweep 1 leaves at a particle i
//   coefficients   from the moments of i and its fit
//   gradient       grad N_j(x_i)/V_j of a neighbour at x_ji = x_j - x_i
//   set_source     V sigma times the coefficients, so that at any x_ik
//   flux           is V_k sigma_k grad N_i(x_k)/V_i, of which CF (43) is the sum
//   own_flux       is sigma_i grad N_i(x_i)
// and of every one sum_j grad N_j(x_i) = 0 holds to round-off, so linear momentum closes: for those whose
// shape functions have not the sum one, grad N_i(x_i) is what the sum of the others lacks. With CF (102),
// which takes differences of velocities, that is the consistent choice of test functions. Cost: the default
// one sweep 1, all others two passes over the neighbours there; sweep 2 is the same.

// Where kHasSumOne, the shape functions N_j(x_i) = V_j W (a + b.x_ji) themselves follow from the fit.
template <int Dim>
struct ShapeFunction {
  double a;
  Vec<Dim> b;
};

// Stress points of a particle, from it [m]: the middles of the quarters or eighths of its cube.
template <int Dim>
std::array<Vec<Dim>, Particles<Dim>::kPoints> stress_points(double spacing) {
  std::array<Vec<Dim>, Particles<Dim>::kPoints> points;
  for (std::size_t s = 0; s < points.size(); ++s)
    for (int a = 0; a < Dim; ++a) points[s][a] = ((s >> a) % 2 == 1 ? 0.25 : -0.25) * spacing;
  return points;
}

// A kernel with another operator than the default. Solvers take it in the place of a kernel.
template <typename Base>
struct WithFullDerivative : Base {
  using Base::Base;
};
template <typename Base>
struct WithShepard : Base {
  using Base::Base;
};
template <typename Base>
struct WithSph : Base {
  using Base::Base;
};
template <typename Base>
struct WithCorrectedSph : Base {
  using Base::Base;
};
template <typename Base>
struct WithStressPoints : Base {
  using Base::Base;
};
template <typename Base>
struct WithIsobaricSph : Base {
  using Base::Base;
};

// Moments of the fit, and with F = -W'/r in the place of W: n1 = sum V F x_ji, n2 and n3 likewise with two
// and three factors; n3[a] has x_a as the third.
template <int Dim>
struct SlopeMoments {
  Moments<Dim> fit;
  Vec<Dim> n1 = Vec<Dim>::Zero();
  Mat<Dim> n2 = Mat<Dim>::Zero();

  void add(double VW, double VF, const Vec<Dim>& x_ji) {
    fit.add(VW, x_ji);
    n1 += VF * x_ji;
    n2 += VF * x_ji * x_ji.transpose();
  }
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

  static ShapeFunction<Dim> shape_function(const Fit<Dim>& fit) { return {fit.a, fit.g}; }

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

// CF (1) and (4), symmetrized by CF (102) and (105): grad N_j = V_j F x_ji, grad N_i(x_i) = -n1. The force is
//   f_i = -V_i sum_k V_k F (sigma_i + sigma_k) x_ik.
// Not even of first order near a free surface, but pairwise antisymmetric.
template <int Dim>
struct Sph {
  static constexpr bool kIsDefault = false, kIsIsobaric = false, kHasSumOne = false, kHasPoints = false;
  using Sums = SlopeMoments<Dim>;
  struct Coefficients {
    Vec<Dim> own = Vec<Dim>::Zero();
  };

  static Coefficients coefficients(const Sums& sums, const Fit<Dim>&, double) { return {-sums.n1}; }
  static Vec<Dim> gradient(const Coefficients&, const ValueAndSlope& weight, const Vec<Dim>& x_ji) {
    return weight.f * x_ji;
  }
  static void set_source(double volume, const Mat<Dim>& sigma, const Coefficients& c, Particles<Dim>& fluid,
                         std::size_t i) {
    Source<Dim>& source = fluid.source[i];
    source.s = sigma * c.own;
    source.S = volume * sigma;
  }

  template <typename Kernel>
  static ValueAndSlope weight(const Kernel& kernel, const Vec<Dim>& x) {
    return kernel.value_and_slope(x);
  }
  static double lattice_weight(const ValueAndSlope& weight) { return weight.f; }
  static double lattice_G(double, double) { return 1.0; }
  static double extra_reach(double) { return 0.0; }
  static Vec<Dim> flux(const Particles<Dim>& fluid, std::size_t k, const ValueAndSlope& weight,
                       const Vec<Dim>& x) {
    return weight.f * (fluid.source[k].S * x);
  }
  static Vec<Dim> own_flux(const Source<Dim>& source, double) { return source.s; }
};

// The same for the velocity gradient and the viscous stress; the pressure acts by isobaric.hpp.
template <int Dim>
struct IsobaricSph : Sph<Dim> {
  static constexpr bool kIsIsobaric = true;
};

// SPH with the gradient of linear fields exact (J. Bonet, T.-S. Lok, Comput. Methods Appl. Mech. Eng. 180,
// 1999): grad N_j = V_j F G x_ji with G = n2^-1, whose eigenvalues are floored like those of the fit's C;
// grad N_i(x_i) = -G n1. G has the eigenvectors of n2, so angular momentum closes under pressure.
template <int Dim>
struct CorrectedSph : Sph<Dim> {
  struct Coefficients {
    Mat<Dim> G = Mat<Dim>::Zero();
    Vec<Dim> own = Vec<Dim>::Zero();
  };

  static Coefficients coefficients(const SlopeMoments<Dim>& sums, const Fit<Dim>&, double floor) {
    bool floored = false;
    const Mat<Dim> G = floored_inverse<Dim>(sums.n2, floor, floored);
    return {G, -G * sums.n1};
  }
  static Vec<Dim> gradient(const Coefficients& c, const ValueAndSlope& weight, const Vec<Dim>& x_ji) {
    return weight.f * (c.G * x_ji);
  }
  static void set_source(double volume, const Mat<Dim>& sigma, const Coefficients& c, Particles<Dim>& fluid,
                         std::size_t i) {
    Source<Dim>& source = fluid.source[i];
    source.s = sigma * c.own;
    source.S = volume * sigma * c.G;
  }
  static double lattice_G(double, double lattice_slope) { return 1.0 / lattice_slope; }
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

  static ShapeFunction<Dim> shape_function(const Fit<Dim>& fit) { return {fit.a, fit.g}; }
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

// The operator of what stands for the kernel.
template <int Dim, typename Kernel>
struct OperatorFor {
  using Type = DiffuseMls<Dim>;
};
template <int Dim, typename Base>
struct OperatorFor<Dim, WithFullDerivative<Base>> {
  using Type = FullMls<Dim>;
};
template <int Dim, typename Base>
struct OperatorFor<Dim, WithShepard<Base>> {
  using Type = Shepard<Dim>;
};
template <int Dim, typename Base>
struct OperatorFor<Dim, WithSph<Base>> {
  using Type = Sph<Dim>;
};
template <int Dim, typename Base>
struct OperatorFor<Dim, WithCorrectedSph<Base>> {
  using Type = CorrectedSph<Dim>;
};
template <int Dim, typename Base>
struct OperatorFor<Dim, WithIsobaricSph<Base>> {
  using Type = IsobaricSph<Dim>;
};
template <int Dim, typename Base>
struct OperatorFor<Dim, WithStressPoints<Base>> {
  using Type = StressPoints<Dim>;
};
template <int Dim, typename Kernel>
using Operator = typename OperatorFor<Dim, Kernel>::Type;

}  // namespace sluice::fluid
