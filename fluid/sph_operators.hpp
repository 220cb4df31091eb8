#pragma once

#include "fluid/kernel.hpp"
#include "fluid/moments.hpp"
#include "fluid/particles.hpp"

namespace sluice::fluid {

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

}  // namespace sluice::fluid
