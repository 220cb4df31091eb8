#include <gtest/gtest.h>

#include "fluid/operator_sweep.hpp"
#include "tests/unit/fluid/clouds.hpp"

namespace sluice::fluid {
namespace {

constexpr double kSpacing = 0.02;

template <int Dim, typename Kernel>
Model<Dim, Kernel> make_model() {
  Setup setup;
  setup.dimension = Dim;
  setup.spacing = kSpacing;
  setup.liquid = {1000, 0, 10};
  setup.fluid.volume = std::pow(kSpacing, Dim);
  return Model<Dim, Kernel>(setup);
}

// A disordered block, free on all sides, with linear fields of velocity and density.
template <int Dim>
struct Block {
  explicit Block(std::uint64_t seed) {
    std::mt19937_64 random(seed);
    L = random_matrix<Dim>(random);
    slope = 1000.0 * random_vector<Dim>(random);
    const Vec<Dim> v0 = random_vector<Dim>(random);
    for (const Vec<Dim>& x : jittered_lattice<Dim>(kCells, kSpacing, 0.2, random)) {
      const double volume = std::pow(kSpacing, Dim) * (1.0 + 0.1 * random_vector<Dim>(random)[0]);
      nodes.push_back({x, v0 + L * x, volume, 1000.0 + slope.dot(x)});
    }
  }

  template <typename Kernel>
  [[nodiscard]] OperatorGradients<Dim, Kernel> gradients(const Model<Dim, Kernel>& model,
                                                         std::size_t i) const {
    std::vector<std::uint32_t> others;
    for (std::uint32_t j = 0; j < nodes.size(); ++j)
      if (j != i) others.push_back(j);
    OperatorSweep<Dim, Kernel> sweep(model, nodes[i]);
    sweep.gather(others, nodes);
    return sweep.finish();
  }

  // N_j at x by definition, from the nodes as they are; V_j W where the operator has no fit.
  template <typename Kernel>
  [[nodiscard]] double shape_function(const Model<Dim, Kernel>& model, std::size_t j,
                                      const Vec<Dim>& x) const {
    const double VW = nodes[j].volume * model.kernel.value(Vec<Dim>(nodes[j].x - x));
    if constexpr (Operator<Dim, Kernel>::kHasSumOne) {
      Moments<Dim> m;
      for (const Node<Dim>& n : nodes) m.add(n.volume * model.kernel.value(Vec<Dim>(n.x - x)), n.x - x);
      const ShapeFunction<Dim> N = Operator<Dim, Kernel>::shape_function(fit(m, model.moment_floor));
      return VW * (N.a + N.b.dot(nodes[j].x - x));
    } else {
      return VW;
    }
  }

  static constexpr int kCells = Dim == 2 ? 8 : 6;
  Mat<Dim> L;
  Vec<Dim> slope;
  std::vector<Node<Dim>> nodes;
};

template <int Dim, typename Kernel>
void expect_exact_for_linear_fields() {
  const auto model = make_model<Dim, Kernel>();
  const Block<Dim> block(7);
  std::size_t exact = 0;
  for (std::size_t i = 0; i < block.nodes.size(); ++i) {
    const auto g = block.gradients(model, i);
    if (g.fit.floored || (g.L - block.L).norm() > 1e-11) continue;
    ++exact;
    EXPECT_LT((g.grad_rho - block.slope).norm(), 1e-6);
  }
  // The floor is for spray: only the edges of the block may miss.
  EXPECT_GE(exact, block.nodes.size() - edge_particles<Dim>(Block<Dim>::kCells));
}

TEST(Approximation, FullDerivativeIsExactForLinearFields) {
  expect_exact_for_linear_fields<2, WithFullDerivative<WendlandC2<2>>>();
  expect_exact_for_linear_fields<3, WithFullDerivative<WendlandC2<3>>>();
}

TEST(Approximation, CorrectedSphIsExactForLinearFields) {
  expect_exact_for_linear_fields<2, WithCorrectedSph<WendlandC2<2>>>();
  expect_exact_for_linear_fields<3, WithCorrectedSph<WendlandC2<3>>>();
}

// Central differences of the shape functions while the point moves through the fixed nodes.
template <int Dim, typename Kernel>
void expect_true_derivative() {
  const auto model = make_model<Dim, Kernel>();
  const Block<Dim> block(3);
  const double step = 1e-5 * kSpacing;
  std::size_t checked = 0;
  for (std::size_t i = 0; i < block.nodes.size(); i += 5) {
    const auto g = block.gradients(model, i);
    if (g.fit.floored) continue;
    for (std::size_t j = 0; j < block.nodes.size(); ++j) {
      const Vec<Dim> x_ji = block.nodes[j].x - block.nodes[i].x;
      if (j == i || x_ji.norm() > model.kernel.support()) continue;
      const Vec<Dim> grad_N =
          block.nodes[j].volume *
          Operator<Dim, Kernel>::gradient(g.coefficients, model.kernel.value_and_slope(x_ji), x_ji);
      for (int a = 0; a < Dim; ++a) {
        const Vec<Dim> ahead = block.nodes[i].x + step * Vec<Dim>::Unit(a);
        const Vec<Dim> behind = block.nodes[i].x - step * Vec<Dim>::Unit(a);
        const double difference =
            (block.shape_function(model, j, ahead) - block.shape_function(model, j, behind)) / (2 * step);
        EXPECT_NEAR(grad_N[a] * kSpacing, difference * kSpacing, 1e-8);
        ++checked;
      }
    }
  }
  EXPECT_GT(checked, 100u);
}

TEST(Approximation, FullDerivativeIsThatOfTheShapeFunctions) {
  expect_true_derivative<2, WithFullDerivative<WendlandC2<2>>>();
  expect_true_derivative<3, WithFullDerivative<WendlandC2<3>>>();
}
TEST(Approximation, ShepardsDerivativeIsThatOfTheShapeFunctions) {
  expect_true_derivative<2, WithShepard<WendlandC2<2>>>();
  expect_true_derivative<3, WithShepard<WendlandC2<3>>>();
}
TEST(Approximation, SphDerivativeIsThatOfTheKernel) {
  expect_true_derivative<2, WithSph<WendlandC2<2>>>();
  expect_true_derivative<3, WithSph<WendlandC2<3>>>();
}

// sum_j N_j = 1, and with it sum_j grad N_j = 0, grad N_i(x_i) included.
template <int Dim, typename Kernel>
void expect_sum_one() {
  const auto model = make_model<Dim, Kernel>();
  const Block<Dim> block(5);
  for (std::size_t i = 0; i < block.nodes.size(); ++i) {
    const auto g = block.gradients(model, i);
    const ShapeFunction<Dim> N = Operator<Dim, Kernel>::shape_function(g.fit);
    double sum = 0;
    Vec<Dim> sum_grad = Vec<Dim>::Zero();
    for (const Node<Dim>& j : block.nodes) {
      const Vec<Dim> x_ji = j.x - block.nodes[i].x;
      const ValueAndSlope weight = model.kernel.value_and_slope(x_ji);
      sum += j.volume * weight.w * (N.a + N.b.dot(x_ji));
      sum_grad += j.volume * Operator<Dim, Kernel>::gradient(g.coefficients, weight, x_ji);
    }
    EXPECT_NEAR(sum, 1.0, 1e-12);
    EXPECT_LT(sum_grad.norm() * kSpacing, 1e-11);
  }
}

TEST(Approximation, FittedShapeFunctionsSumToOne) {
  expect_sum_one<2, WithFullDerivative<WendlandC2<2>>>();
  expect_sum_one<3, WithFullDerivative<WendlandC2<3>>>();
  expect_sum_one<2, WithShepard<WendlandC2<2>>>();
  expect_sum_one<3, WithShepard<WendlandC2<3>>>();
}

}  // namespace
}  // namespace sluice::fluid
