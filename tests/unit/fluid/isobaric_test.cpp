#include "fluid/isobaric.hpp"

#include <gtest/gtest.h>

namespace sluice::fluid {
namespace {

// The conditions that PC states of (15), which the printed polynomial breaks.
TEST(IsobaricPressure, WeightKeepsThePapersConditions) {
  for (const double delta : {0.05, 0.1, 0.25}) {
    EXPECT_EQ(isobaric_weight(0.0, delta), 2.0);
    EXPECT_EQ(isobaric_weight(1.0, delta), 0.0);
    EXPECT_NEAR((isobaric_weight(1e-6, delta) - 2.0) / 1e-6, 0.0, 1e-2);  // alpha'(0) = 0
    EXPECT_NEAR(isobaric_weight(delta, delta), 1.0 - delta * delta, 1e-12);
    double before = 2.0;
    for (int k = 1; k <= 1000; ++k) {
      const double alpha = isobaric_weight(k / 1000.0, delta);
      EXPECT_GE(alpha, 0.0);
      EXPECT_LT(alpha, before);
      before = alpha;
    }
  }
}

TEST(IsobaricPressure, EqualPressuresHaveNoForce) {
  for (const double p : {-50.0, 0.0, 3000.0}) EXPECT_EQ(isobaric_pressure({p, 1000}, {p, 1000}, 0.1), 0.0);
}

// Against nothing, 2 p would act in CF (105); PC (10) with rho_i^2 p_i/rho_i^2 = p_i.
TEST(IsobaricPressure, AgainstNoPressureTheSumActs) {
  EXPECT_DOUBLE_EQ(isobaric_pressure({3000, 1000}, {0, 1000}, 0.1), 3000);
  EXPECT_DOUBLE_EQ(isobaric_pressure({0, 1000}, {3000, 1000}, 0.1), 3000);
}

TEST(IsobaricPressure, ThePartOfTheDifferenceIsNotAntisymmetric) {
  const double from_i = isobaric_pressure({3000, 1000}, {2990, 1000}, 0.1);
  const double from_j = isobaric_pressure({2990, 1000}, {3000, 1000}, 0.1);
  EXPECT_NE(from_i, from_j);  // equal would be Newton's third law, since x_ij changes its sign
}

TEST(IsobaricPressure, OppositePressuresAreFarApart) {
  EXPECT_DOUBLE_EQ(isobaric_pressure({3000, 1000}, {-3000, 1000}, 0.1), 0.0);
  EXPECT_DOUBLE_EQ(isobaric_pressure({3000, 1000}, {-1000, 1000}, 0.1), 2000.0);
}

}  // namespace
}  // namespace sluice::fluid
