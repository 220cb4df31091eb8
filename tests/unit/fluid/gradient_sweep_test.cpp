#include "fluid/gradient_sweep.hpp"

#include <gtest/gtest.h>

#include "tests/unit/fluid/clouds.hpp"

namespace sluice::fluid {
namespace {

constexpr double kSpacing = 0.02;

template <int Dim>
Model<Dim> make_model() {
  Setup setup;
  setup.dimension = Dim;
  setup.spacing = kSpacing;
  setup.liquid = {1000, 0, 10};
  setup.fluid.volume = std::pow(kSpacing, Dim);
  return Model<Dim>(setup);
}

template <int Dim>
Gradients<Dim> gradients_at(const Model<Dim>& model, const std::vector<Node<Dim>>& nodes, std::size_t i) {
  std::vector<std::uint32_t> others;
  for (std::uint32_t j = 0; j < nodes.size(); ++j)
    if (j != i) others.push_back(j);
  GradientSweep<Dim> sweep(model, nodes[i]);
  sweep.gather(others, nodes);
  return sweep.finish();
}

// Linear fields of velocity and density on disordered particles: their gradients must come back exactly.
template <int Dim>
void check_linear_fields(std::uint64_t seed) {
  SCOPED_TRACE("dimension " + std::to_string(Dim) + ", seed " + std::to_string(seed));
  std::mt19937_64 random(seed);
  const Model<Dim> model = make_model<Dim>();
  const Mat<Dim> L = random_matrix<Dim>(random);
  const Vec<Dim> v0 = random_vector<Dim>(random), slope = 1000.0 * random_vector<Dim>(random);
  std::vector<Node<Dim>> nodes;
  for (const Vec<Dim>& x : jittered_lattice<Dim>(8, kSpacing, 0.2, random)) {
    const double volume = std::pow(kSpacing, Dim) * (1.0 + 0.1 * random_vector<Dim>(random)[0]);
    nodes.push_back({x, v0 + L * x, volume, 1000.0 + slope.dot(x)});
  }
  std::size_t exact = 0;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const Gradients<Dim> g = gradients_at(model, nodes, i);
    if (g.fit.floored) continue;
    ++exact;
    EXPECT_LT((g.L - L).norm(), 1e-12);
    EXPECT_LT((g.grad_rho - slope).norm(), 1e-12 * 1e5);  // of differences of numbers near 1000 over 0.02
  }
  EXPECT_GE(exact, nodes.size() - edge_particles<Dim>(8));
}

TEST(GradientSweep, LinearFieldsAreExact) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    check_linear_fields<2>(seed);
    check_linear_fields<3>(seed);
  }
}

TEST(GradientSweep, UniformFieldsHaveNoGradientEvenInSpray) {
  const Model<2> model = make_model<2>();
  const Vec<2> v{3.0, -4.0};
  const std::vector<Node<2>> nodes{{Vec<2>(0, 0), v, 4e-4, 1000}, {Vec<2>(0.7 * kSpacing, 0), v, 4e-4, 1000}};
  const Gradients<2> g = gradients_at(model, nodes, 0);
  EXPECT_TRUE(g.fit.floored);
  EXPECT_EQ(g.L, Mat<2>::Zero());
  EXPECT_EQ(g.grad_rho, Vec<2>::Zero());
}

}  // namespace
}  // namespace sluice::fluid
