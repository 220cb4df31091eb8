#pragma once

#include "fluid/mls_operators.hpp"
#include "fluid/sph_operators.hpp"
#include "fluid/stress_point_operator.hpp"

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
