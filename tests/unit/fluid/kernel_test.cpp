#include "fluid/kernel.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace sluice::fluid {
namespace {

template <int Dim>
struct Dimension {
  static constexpr int value = Dim;
};

template <typename D>
class Kernel : public testing::Test {
 protected:
  static constexpr int kDim = D::value;
  static constexpr std::array<double, 5> kLengths{1.0, 0.3, 1.5e-3, 7.25, 0.0123};
};
using Dimensions = testing::Types<Dimension<2>, Dimension<3>>;
TYPED_TEST_SUITE(Kernel, Dimensions);

// Four-point Gauss-Legendre is exact to degree 7, the degree of W r^2.
template <typename Function>
double integrate(double from, double to, const Function& f) {
  const std::array<std::array<double, 2>, 4> rule{{{-0.861136311594052575224, 0.347854845137453857373},
                                                   {-0.339981043584856264803, 0.652145154862546142627},
                                                   {0.339981043584856264803, 0.652145154862546142627},
                                                   {0.861136311594052575224, 0.347854845137453857373}}};
  double sum = 0;
  for (const auto& [point, weight] : rule)
    sum += 0.5 * (to - from) * weight * f(0.5 * (from + to) + 0.5 * (to - from) * point);
  return sum;
}

// Of the circle or the sphere of radius r.
template <int Dim>
double sphere_area(double r) {
  return Dim == 2 ? 2.0 * std::numbers::pi * r : 4.0 * std::numbers::pi * r * r;
}

TYPED_TEST(Kernel, IntegratesToOne) {
  for (const double h : this->kLengths) {
    const WendlandC2<TestFixture::kDim> kernel(h);
    const double integral = integrate(0.0, kernel.support(), [&](double r) {
      return kernel.value(r * r) * sphere_area<TestFixture::kDim>(r);
    });
    EXPECT_NEAR(integral, 1.0, 1e-12) << "h = " << h;
  }
}

TYPED_TEST(Kernel, SlopeIsMinusTheDerivativeOverTheDistance) {
  for (const double h : this->kLengths) {
    const WendlandC2<TestFixture::kDim> kernel(h);
    const double scale = kernel.at_zero() / (h * h), e = 1e-5 * h;
    for (double q = 0.05; q < 2.2; q += 0.05) {
      const double r = q * h;
      const double central = (kernel.value((r + e) * (r + e)) - kernel.value((r - e) * (r - e))) / (2.0 * e);
      EXPECT_NEAR(kernel.value_and_slope(r * r).f / scale, -central / r / scale, 1e-8) << "q = " << q;
    }
  }
}

TYPED_TEST(Kernel, BothWaysToTheValueAgree) {
  const WendlandC2<TestFixture::kDim> kernel(0.3);
  for (double q = 0.0; q < 2.5; q += 0.01) {
    const double r2 = q * q * 0.09;
    EXPECT_DOUBLE_EQ(kernel.value(r2), kernel.value_and_slope(r2).w);
  }
}

TYPED_TEST(Kernel, FallsFromTheCentreToTheSupport) {
  const WendlandC2<TestFixture::kDim> kernel(0.3);
  EXPECT_DOUBLE_EQ(kernel.value(0.0), kernel.at_zero());
  EXPECT_DOUBLE_EQ(kernel.support(), 0.6);
  for (double r = 0.0; r < 0.58; r += 0.01) {
    EXPECT_GT(kernel.value(r * r), kernel.value((r + 0.01) * (r + 0.01)));
    EXPECT_GT(kernel.value_and_slope(r * r).f, 0.0);
  }
}

TYPED_TEST(Kernel, IsExactlyZeroFromTheSupportOn) {
  for (const double h : this->kLengths) {
    const WendlandC2<TestFixture::kDim> kernel(h);
    const double s = kernel.support();
    for (const double r : {s, 1.000001 * s, 1.5 * s, 1e3 * s, 1e150 * s}) {
      EXPECT_EQ(kernel.value(r * r), 0.0) << "h = " << h << ", r = " << r;
      EXPECT_EQ(kernel.value_and_slope(r * r).w, 0.0) << "h = " << h << ", r = " << r;
      EXPECT_EQ(kernel.value_and_slope(r * r).f, 0.0) << "h = " << h << ", r = " << r;
    }
    EXPECT_GT(kernel.value(0.998 * s * s), 0.0);
  }
}

}  // namespace
}  // namespace sluice::fluid
