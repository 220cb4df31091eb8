#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include "fluid/moments.hpp"
#include "tests/unit/fluid/clouds.hpp"

namespace sluice::fluid {
namespace {

constexpr double kFloor = 0.1;

template <int Dim>
struct Neighbor {
  double weight;
  Vec<Dim> x;
};

template <int Dim>
Vec<Dim> smallest_first_eigenvalues(const Mat<Dim>& a) {
  return Eigen::SelfAdjointEigenSolver<Mat<Dim>>(a).eigenvalues();
}

// What must hold of the fit when there are too few neighbours for the exact one.
template <int Dim>
void expect_floored(const std::vector<Neighbor<Dim>>& neighbors) {
  Moments<Dim> m;
  for (const auto& n : neighbors) m.add(n.weight, n.x);
  const Fit<Dim> f = fit(m, kFloor);
  EXPECT_TRUE(f.floored);
  Vec<Dim> sum_grad = Vec<Dim>::Zero();
  for (const auto& n : neighbors) sum_grad += n.weight * (f.g + f.G * n.x);
  EXPECT_LT(sum_grad.norm(), 1e-12);
  const Mat<Dim> C = m.m2 - m.m1 * m.m1.transpose() / m.m0;
  EXPECT_LT((f.G * C - C * f.G).norm(), 1e-12);
  const Vec<Dim> eigenvalues = smallest_first_eigenvalues<Dim>(f.G);
  EXPECT_GT(eigenvalues[0], 0.0);
  const double floor = kFloor * std::max(1.0, m.m0);
  bool floored = false;
  const Mat<Dim> G = floored_inverse<Dim>(C, floor, floored);  // of which the fit keeps a half
  EXPECT_LT((G - G.transpose()).norm(), 1e-12);
  EXPECT_LE(eigenvalues[Dim - 1], (1.0 + 1e-12) / floor);
  EXPECT_GE(eigenvalues[Dim - 1], (1.0 - 1e-12) / floor);  // it is the floor that binds
}

template <int Dim>
void check_sparse_neighborhoods() {
  const Vec<Dim> zero = Vec<Dim>::Zero();
  std::mt19937_64 random(11);
  for (int k = 0; k < 50; ++k) {
    SCOPED_TRACE(k);
    const Vec<Dim> e = random_direction<Dim>(random);
    expect_floored<Dim>({{0.4, zero}});                                                  // alone
    expect_floored<Dim>({{0.4, zero}, {0.2, 0.7 * e}});                                  // one neighbour
    expect_floored<Dim>({{0.4, zero}, {0.2, 0.7 * e}, {0.3, -1.1 * e}});                 // two, in a line
    expect_floored<Dim>({{0.4, zero}, {0.4, zero}, {0.4, zero}});                        // coincident
    expect_floored<Dim>({{9.0, zero}, {9.0, 2.0 * e}, {9.0, 4.0 * e}, {9.0, -e}});       // many, in a line
    expect_floored<Dim>({{1e-9, zero}, {1e-9, random_vector<Dim>(random)}, {1e-9, e}});  // hardly any
  }
}

TEST(Fit, FloorKeepsMomentumWithFewNeighborsInThePlane) {
  check_sparse_neighborhoods<2>();
}

TEST(Fit, FloorKeepsMomentumWithFewNeighborsInSpace) {
  check_sparse_neighborhoods<3>();
  std::mt19937_64 random(12);
  for (int k = 0; k < 50; ++k) {  // a plane of neighbours: one eigenvalue of three is zero
    const Vec<3> e1 = random_direction<3>(random), e2 = random_direction<3>(random);
    expect_floored<3>({{1, Vec<3>::Zero()}, {1, e1}, {1, e2}, {1, -e1 - e2}, {1, e1 - e2}});
  }
}

template <int Dim>
void check_exact_fit() {
  std::mt19937_64 random(13);
  for (int k = 0; k < 50; ++k) {
    Moments<Dim> m;
    for (int j = 0; j < 30; ++j) m.add(1.0 / 30.0 - 1e-12, random_vector<Dim>(random));  // m0 below 1
    const Mat<Dim> C = m.m2 - m.m1 * m.m1.transpose() / m.m0;
    const double smallest = smallest_first_eigenvalues<Dim>(C)[0];
    const Fit<Dim> f = fit(m, 0.999 * smallest);
    EXPECT_FALSE(f.floored);
    EXPECT_LT((f.G * C - Mat<Dim>::Identity()).norm(), 1e-12);
    EXPECT_TRUE(fit(m, 1.001 * smallest).floored);
    // Both ways to G meet at the floor.
    EXPECT_LT((fit(m, (1.0 + 1e-9) * smallest).G.full() - f.G.full()).norm(), 1e-8 * f.G.norm());
  }
}

TEST(Fit, IsExactAboveTheFloor) {
  check_exact_fit<2>();
  check_exact_fit<3>();
}

template <int Dim>
void check_inverse() {
  std::mt19937_64 random(14);
  for (int k = 0; k < 200; ++k) {
    const Mat<Dim> A = random_matrix<Dim>(random);
    const Mat<Dim> S = A * A.transpose() + 0.05 * Mat<Dim>::Identity();
    const Mat<Dim> reference = S.inverse();
    EXPECT_LT((symmetric_inverse<Dim>(S) - reference).norm(), 1e-12 * reference.norm() * reference.norm());
    EXPECT_EQ(symmetric_inverse<Dim>(S), symmetric_inverse<Dim>(S).transpose());
  }
}

TEST(SymmetricInverse, AgreesWithEigen) {
  check_inverse<2>();
  check_inverse<3>();
}

template <int Dim>
void check_eigenvalues_above() {
  std::mt19937_64 random(15);
  for (int k = 0; k < 200; ++k) {
    const Mat<Dim> A = random_matrix<Dim>(random);
    const Mat<Dim> S = A + A.transpose();
    const Vec<Dim> eigenvalues = smallest_first_eigenvalues<Dim>(S);
    // Between and beyond all eigenvalues: two or three of them below the bound must not pass either.
    EXPECT_TRUE(eigenvalues_above<Dim>(S, eigenvalues[0] - 1e-6));
    for (int a = 0; a < Dim; ++a) EXPECT_FALSE(eigenvalues_above<Dim>(S, eigenvalues[a] + 1e-6)) << a;
  }
}

TEST(EigenvaluesAbove, AgreesWithEigen) {
  check_eigenvalues_above<2>();
  check_eigenvalues_above<3>();
}

}  // namespace
}  // namespace sluice::fluid
