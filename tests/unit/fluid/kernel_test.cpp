#include "fluid/kernel.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace sluice::fluid {
namespace {

template <typename K, int Dim>
struct Case {
  using Type = K;
  static constexpr int kDim = Dim;
};

template <typename C>
class Kernel : public testing::Test {
 protected:
  static constexpr int kDim = C::kDim;
  static constexpr std::array<double, 5> kLengths{1.0, 0.3, 1.5e-3, 7.25, 0.0123};
};
using Radial = testing::Types<Case<WendlandC2<2>, 2>, Case<WendlandC2<3>, 3>, Case<CubicSpline<2>, 2>,
                              Case<CubicSpline<3>, 3>, Case<SincSquared<2>, 2>, Case<SincSquared<3>, 3>>;
TYPED_TEST_SUITE(Kernel, Radial);

// Four-point Gauss-Legendre, exact to degree 7, on each of 64 panels.
template <typename Function>
double integrate(double from, double to, const Function& f) {
  const std::array<std::array<double, 2>, 4> rule{{{-0.861136311594052575224, 0.347854845137453857373},
                                                   {-0.339981043584856264803, 0.652145154862546142627},
                                                   {0.339981043584856264803, 0.652145154862546142627},
                                                   {0.861136311594052575224, 0.347854845137453857373}}};
  constexpr int kPanels = 64;
  const double half = 0.5 * (to - from) / kPanels;
  double sum = 0;
  for (int panel = 0; panel < kPanels; ++panel)
    for (const auto& [point, weight] : rule) sum += half * weight * f(from + half * (2 * panel + 1 + point));
  return sum;
}

// Of the circle or the sphere of radius r.
template <int Dim>
double sphere_area(double r) {
  return Dim == 2 ? 2.0 * std::numbers::pi * r : 4.0 * std::numbers::pi * r * r;
}

TYPED_TEST(Kernel, IntegratesToOne) {
  for (const double h : this->kLengths) {
    const typename TypeParam::Type kernel(h);
    const double integral = integrate(0.0, kernel.support(), [&](double r) {
      return kernel.value(r * r) * sphere_area<TestFixture::kDim>(r);
    });
    EXPECT_NEAR(integral, 1.0, 1e-12) << "h = " << h;
  }
}

TYPED_TEST(Kernel, SlopeIsMinusTheDerivativeOverTheDistance) {
  for (const double h : this->kLengths) {
    const typename TypeParam::Type kernel(h);
    const double scale = kernel.at_zero() / (h * h), e = 1e-5 * h;
    for (double q = 0.03; q < 2.2; q += 0.05) {
      const double r = q * h;
      const double central = (kernel.value((r + e) * (r + e)) - kernel.value((r - e) * (r - e))) / (2.0 * e);
      EXPECT_NEAR(kernel.value_and_slope(r * r).f / scale, -central / r / scale, 1e-8) << "q = " << q;
    }
  }
}

TYPED_TEST(Kernel, BothWaysToTheValueAgree) {
  const typename TypeParam::Type kernel(0.3);
  for (double q = 0.0; q < 2.5; q += 0.01) {
    const double r2 = q * q * 0.09;
    EXPECT_DOUBLE_EQ(kernel.value(r2), kernel.value_and_slope(r2).w);
  }
}

TYPED_TEST(Kernel, FallsFromTheCentreToTheSupport) {
  const typename TypeParam::Type kernel(0.3);
  EXPECT_DOUBLE_EQ(kernel.value(0.0), kernel.at_zero());
  EXPECT_DOUBLE_EQ(kernel.support(), 0.6);
  for (double r = 0.0; r < 0.58; r += 0.01) {
    EXPECT_GT(kernel.value(r * r), kernel.value((r + 0.01) * (r + 0.01)));
    EXPECT_GT(kernel.value_and_slope(r * r).f, 0.0);
  }
}

TYPED_TEST(Kernel, IsExactlyZeroFromTheSupportOn) {
  for (const double h : this->kLengths) {
    const typename TypeParam::Type kernel(h);
    const double s = kernel.support();
    for (const double r : {s, 1.000001 * s, 1.5 * s, 1e3 * s, 1e150 * s}) {
      EXPECT_EQ(kernel.value(r * r), 0.0) << "h = " << h << ", r = " << r;
      EXPECT_EQ(kernel.value_and_slope(r * r).w, 0.0) << "h = " << h << ", r = " << r;
      EXPECT_EQ(kernel.value_and_slope(r * r).f, 0.0) << "h = " << h << ", r = " << r;
    }
    EXPECT_GT(kernel.value(0.998 * s * s), 0.0);
  }
}

TEST(TensorSpline, IntegratesToOne) {
  const TensorSpline<2> kernel(0.3);
  const double integral = integrate(-0.6, 0.6, [&](double x) {
    return integrate(-0.6, 0.6, [&](double y) { return kernel.value(Vec<2>(x, y)); });
  });
  EXPECT_NEAR(integral, 1.0, 1e-12);
}

TEST(TensorSpline, ReachesTheCornersOfItsSquare) {
  const TensorSpline<2> kernel(0.3);
  EXPECT_GT(kernel.value(Vec<2>(0.59, 0.59)), 0.0);
  EXPECT_EQ(kernel.value(Vec<2>(0.61, 0.0)), 0.0);
  EXPECT_GT(kernel.support(), Vec<2>(0.6, 0.6).norm() - 1e-15);
}

}  // namespace
}  // namespace sluice::fluid
