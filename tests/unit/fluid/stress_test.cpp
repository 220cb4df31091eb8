#include "fluid/stress.hpp"

#include <gtest/gtest.h>

#include "tests/unit/fluid/clouds.hpp"

namespace sluice::fluid {
namespace {

constexpr double kMu = 0.7;

TEST(Stress, ShearGivesTheTextbookValue) {
  Mat<2> L = Mat<2>::Zero();
  L(0, 1) = 3.0;  // v_x = 3 y
  const Mat<2> stress = viscous_stress<2>(kMu, strain_rate<2>(L));
  EXPECT_DOUBLE_EQ(stress(0, 1), kMu * 3.0);
  EXPECT_DOUBLE_EQ(stress(1, 0), kMu * 3.0);
  EXPECT_EQ(stress(0, 0), 0.0);
  EXPECT_EQ(stress(1, 1), 0.0);
}

TEST(Stress, RigidRotationGivesNone) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    const Mat<3> A = random_matrix<3>(random);
    EXPECT_EQ(viscous_stress<3>(kMu, strain_rate<3>(A - A.transpose())), Mat<3>::Zero());
    const Mat<2> B = random_matrix<2>(random);
    EXPECT_EQ(viscous_stress<2>(kMu, strain_rate<2>(B - B.transpose())), Mat<2>::Zero());
  }
}

TEST(Stress, HasNoTraceInThreeDimensions) {
  std::mt19937_64 random(4);
  for (int k = 0; k < 20; ++k) {
    const Mat<3> L = random_matrix<3>(random);
    EXPECT_NEAR(viscous_stress<3>(kMu, strain_rate<3>(L)).trace(), 0.0, 1e-14);
  }
}

// A planar flow is the three-dimensional one without strain along z: the same stress in the plane.
TEST(Stress, PlanarFlowIsTheSliceOfTheSpatialOne) {
  std::mt19937_64 random(5);
  for (int k = 0; k < 20; ++k) {
    const Mat<2> L = random_matrix<2>(random);
    Mat<3> L3 = Mat<3>::Zero();
    L3.topLeftCorner<2, 2>() = L;
    const Mat<2> stress = viscous_stress<2>(kMu, strain_rate<2>(L));
    const Mat<3> spatial = viscous_stress<3>(kMu, strain_rate<3>(L3));
    EXPECT_LT((stress - spatial.topLeftCorner<2, 2>()).norm(), 1e-14);
    EXPECT_NEAR(stress.trace(), 2.0 / 3.0 * kMu * L.trace(), 1e-14);
    EXPECT_EQ(stress, stress.transpose());
  }
}

TEST(Stress, DissipatesWhateverTheStrain) {
  std::mt19937_64 random(6);
  for (int k = 0; k < 100; ++k) {
    const Mat<3> L = random_matrix<3>(random);
    EXPECT_GT((viscous_stress<3>(kMu, strain_rate<3>(L)).array() * L.array()).sum(), 0.0);
  }
}

TEST(Stress, SourceIsTheStressOnTheFit) {
  std::mt19937_64 random(7);
  const Mat<3> sigma = strain_rate<3>(random_matrix<3>(random));
  const Fit<3> fit{random_vector<3>(random), strain_rate<3>(random_matrix<3>(random)), 1.0, false};
  Source<3> source;
  set_source<3>(0.3, sigma, fit, source);
  EXPECT_LT((source.s - 0.3 * sigma * fit.g).norm(), 1e-15);
  EXPECT_LT((source.S - 0.3 * sigma * fit.G).norm(), 1e-15);
}

}  // namespace
}  // namespace sluice::fluid
