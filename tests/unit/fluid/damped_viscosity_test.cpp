#include "fluid/damped_viscosity.hpp"

#include <gtest/gtest.h>

namespace sluice::fluid {
namespace {

template <int Dim>
Model<Dim> make_model(double length, double mass) {
  Setup setup;  // units: lengths times `length`, masses times `mass`
  setup.dimension = Dim;
  setup.spacing = 0.1 * length;
  setup.liquid = {1000 * mass / (length * length * length), 0.5 * mass / length, 20 * length};
  setup.formulation.viscous_force = ViscousForce::damped;
  setup.formulation.smoothing = 3;  // so many neighbours that sums are integrals
  setup.fluid.volume = std::pow(setup.spacing, Dim);
  return Model<Dim>(setup);
}

Node<3> node(const Vec<3>& x, const Vec<3>& v, double rho, double length, double mass) {
  return {length * x, length * v, 1e-3 * length * length * length, rho * mass / (length * length * length)};
}

TEST(DampedViscosity, AUniformVelocityHasNoForce) {
  const auto model = make_model<3>(1, 1);
  const Vec<3> v(3, -4, 5);
  EXPECT_EQ(damped_force<3>(model, node({0, 0, 0}, v, 1010, 1, 1), node({0.1, 0.05, 0}, v, 990, 1, 1)),
            Vec<3>(0, 0, 0));
}

TEST(DampedViscosity, IsPairwiseOpposite) {
  const auto model = make_model<3>(1, 1);
  const Node<3> i = node({0, 0, 0}, {3, -4, 5}, 1010, 1, 1), j = node({0.2, 0.05, 0}, {2, 2, 1}, 990, 1, 1);
  const Vec<3> force = damped_force<3>(model, i, j);
  EXPECT_GT(force.norm(), 0.0);
  EXPECT_EQ(damped_force<3>(model, j, i), -force);
}

// The exponent is a number: metres and kilograms or millimetres and grams give the same force.
TEST(DampedViscosity, DoesNotDependOnTheUnits) {
  const Vec<3> x(0.15, 0.05, -0.02), v(3, -4, 5);
  const Vec<3> in_m =
      damped_force<3>(make_model<3>(1, 1), node({0, 0, 0}, v, 1010, 1, 1), node(x, {0, 0, 1}, 990, 1, 1));
  const Vec<3> in_mm = damped_force<3>(make_model<3>(1e3, 1e3), node({0, 0, 0}, v, 1010, 1e3, 1e3),
                                       node(x, {0, 0, 1}, 990, 1e3, 1e3));
  EXPECT_LT((in_mm / 1e6 - in_m).norm(), 1e-12 * in_m.norm());
}

// The sum over a lattice is mu times the Laplacian of v = x^2 in z, per volume, where the velocities are
// small.
template <int Dim>
double laplacian_on_lattice() {
  const auto model = make_model<Dim>(1, 1);
  const double dx = 0.1, V = std::pow(dx, Dim), scale = 1e-6;
  const auto at = [&](const Vec<Dim>& x) {
    Vec<Dim> v = Vec<Dim>::Zero();
    v[1] = scale * x[0] * x[0];
    return Node<Dim>{x, v, V, 1000.0};
  };
  Vec<Dim> sum = Vec<Dim>::Zero();
  for (int a = -6; a <= 6; ++a)
    for (int b = -6; b <= 6; ++b)
      for (int c = Dim == 3 ? -6 : 0; c <= (Dim == 3 ? 6 : 0); ++c) {
        if (a == 0 && b == 0 && c == 0) continue;
        Vec<Dim> x = Vec<Dim>::Zero();
        x[0] = a * dx;
        x[1] = b * dx;
        if constexpr (Dim == 3) x[2] = c * dx;
        sum += damped_force<Dim>(model, at(Vec<Dim>::Zero()), at(x));
      }
  return sum[1] / (V * 0.5 * 2.0 * scale);
}

TEST(DampedViscosity, SumsToTheLaplacian) {
  EXPECT_NEAR(laplacian_on_lattice<2>(), 1.0, 0.01);
  EXPECT_NEAR(laplacian_on_lattice<3>(), 1.0, 0.01);
}

}  // namespace
}  // namespace sluice::fluid
