#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "fluid/types.hpp"

namespace sluice::fluid {

// A kernel is a class with
//   support()           radius beyond which it is exactly zero [m]
//   at_zero()           W(0) [1/m^Dim]
//   value(x)            W at the connection x [m]
//   value_and_slope(x)  W, and F = -W'(r)/r, so that grad W(x_i - x_j) = -F x_ij
// A radial one also takes the squared distance [m^2].
// h is the smoothing length, half the support radius, for all of them. `formulation.hpp` lists them.
struct ValueAndSlope {
  double w;  // [1/m^Dim]
  double f;  // [1/m^(Dim+2)]
};

// Wendland's C2 kernel (H. Wendland, Adv. Comput. Math. 4, 1995):
//   W(r) = A (1 - q/2)^4 (2q + 1),  q = r/h,  A = 7/(4 pi h^2) in 2D, 21/(16 pi h^3) in 3D
//   F(r) = 5 A/h^2 (1 - q/2)^3,  Laplacian 5 A/h^2 (1 - q/2)^2 (3 q/2 - Dim (1 - q/2))
template <int Dim>
class WendlandC2 {
 public:
  explicit WendlandC2(double h)
      : h_(h),
        half_inverse_h_(0.5 / h),
        amplitude_(Dim == 2 ? 7.0 / (4.0 * std::numbers::pi * h * h)
                            : 21.0 / (16.0 * std::numbers::pi * h * h * h)),
        slope_(5.0 * amplitude_ / (h * h)) {}

  [[nodiscard]] double support() const { return 2.0 * h_; }
  [[nodiscard]] double at_zero() const { return amplitude_; }
  [[nodiscard]] double half_inverse_h() const { return half_inverse_h_; }
  // F at zero [1/m^(Dim+2)].
  [[nodiscard]] double slope() const { return slope_; }

  [[nodiscard]] double value(const Vec<Dim>& x) const { return value(x.squaredNorm()); }
  [[nodiscard]] ValueAndSlope value_and_slope(const Vec<Dim>& x) const {
    return value_and_slope(x.squaredNorm());
  }

  [[nodiscard]] double value(double r2) const {
    const double half_q = std::sqrt(r2) * half_inverse_h_;
    const double u = std::max(0.0, 1.0 - half_q);
    const double u2 = u * u;
    return amplitude_ * u2 * u2 * (4.0 * half_q + 1.0);
  }

  [[nodiscard]] ValueAndSlope value_and_slope(double r2) const {
    const double half_q = std::sqrt(r2) * half_inverse_h_;
    const double u = std::max(0.0, 1.0 - half_q);
    const double u3 = u * u * u;
    return {amplitude_ * u3 * u * (4.0 * half_q + 1.0), slope_ * u3};
  }

  // [1/m^(Dim+2)]
  [[nodiscard]] double laplacian(const Vec<Dim>& x) const {
    const double half_q = x.norm() * half_inverse_h_;
    const double u = std::max(0.0, 1.0 - half_q);
    return slope_ * u * u * (3.0 * half_q - Dim * u);
  }

 private:
  double h_, half_inverse_h_, amplitude_, slope_;
};

// The cubic spline CF (18): W = A (1 - 3/2 s^2 + 3/4 s^3), A/4 (2 - s)^3 for s = r/h beyond 1;
// A = 10/(7 pi h^2) in 2D, 1/(pi h^3) in 3D. The paper leaves A away, which with MLS makes no difference.
template <int Dim>
class CubicSpline {
 public:
  explicit CubicSpline(double h)
      : h_(h),
        amplitude_(Dim == 2 ? 10.0 / (7.0 * std::numbers::pi * h * h)
                            : 1.0 / (std::numbers::pi * h * h * h)) {}

  [[nodiscard]] double support() const { return 2.0 * h_; }
  [[nodiscard]] double at_zero() const { return amplitude_; }
  [[nodiscard]] double value(const Vec<Dim>& x) const { return value(x.squaredNorm()); }
  [[nodiscard]] ValueAndSlope value_and_slope(const Vec<Dim>& x) const {
    return value_and_slope(x.squaredNorm());
  }
  [[nodiscard]] double value(double r2) const { return value_and_slope(r2).w; }

  [[nodiscard]] ValueAndSlope value_and_slope(double r2) const {
    const double s = std::sqrt(r2) / h_, per_h2 = amplitude_ / (h_ * h_);
    if (s < 1.0) return {amplitude_ * (1.0 - s * s * (1.5 - 0.75 * s)), per_h2 * (3.0 - 2.25 * s)};
    const double u = std::max(0.0, 2.0 - s);
    return {amplitude_ * 0.25 * u * u * u, per_h2 * 0.75 * u * u / s};
  }

 private:
  double h_, amplitude_;
};

// The product of one-dimensional cubic splines CF (19), with support in a square or cube of edge 4h. It is
// not radial; F is that of the radial spline, and only the dissipation uses it.
template <int Dim>
class TensorSpline {
 public:
  explicit TensorSpline(double h) : h_(h), radial_(h) {}

  [[nodiscard]] double support() const { return 2.0 * h_ * std::sqrt(static_cast<double>(Dim)); }
  [[nodiscard]] double at_zero() const { return value(Vec<Dim>::Zero()); }

  [[nodiscard]] double value(const Vec<Dim>& x) const {
    double product = 1.0;
    for (int a = 0; a < Dim; ++a) product *= factor(std::abs(x[a]) / h_);
    return product;
  }

  [[nodiscard]] ValueAndSlope value_and_slope(const Vec<Dim>& x) const {
    return {value(x), radial_.value_and_slope(x).f};
  }

 private:
  // CF (18) in one dimension: A = 2/(3h).
  [[nodiscard]] double factor(double s) const {
    const double amplitude = 2.0 / (3.0 * h_), u = std::max(0.0, 2.0 - s);
    return amplitude * (s < 1.0 ? 1.0 - s * s * (1.5 - 0.75 * s) : 0.25 * u * u * u);
  }

  double h_;
  CubicSpline<Dim> radial_;
};

// PC (19): W = A0 (sin u/u)^2, u = pi r/R with support radius R = 2h. The printed A0 is not normalised (it is
// 10.9 % high in 3D); here A0 = pi/(Cin(2 pi) R^2) in 2D, pi/(2 R^3) in 3D. It calls libm's sine and cosine,
// so a run is bit-identical on one machine only.
template <int Dim>
class SincSquared {
 public:
  explicit SincSquared(double h)
      : radius_(2.0 * h),
        amplitude_(Dim == 2 ? std::numbers::pi / (kCin * radius_ * radius_)
                            : std::numbers::pi / (2.0 * radius_ * radius_ * radius_)) {}

  [[nodiscard]] double support() const { return radius_; }
  [[nodiscard]] double at_zero() const { return amplitude_; }
  [[nodiscard]] double value(const Vec<Dim>& x) const { return value(x.squaredNorm()); }
  [[nodiscard]] ValueAndSlope value_and_slope(const Vec<Dim>& x) const {
    return value_and_slope(x.squaredNorm());
  }
  [[nodiscard]] double value(double r2) const { return value_and_slope(r2).w; }

  [[nodiscard]] ValueAndSlope value_and_slope(double r2) const {
    const double scale = std::numbers::pi / radius_, u = scale * std::sqrt(r2);
    if (u >= std::numbers::pi) return {0.0, 0.0};
    // Below 1e-3 the series of sin u/u and of its slope over u are exact to rounding.
    const double sinc = u < 1e-3 ? 1.0 - u * u / 6.0 : std::sin(u) / u;
    const double slope_per_u = u < 1e-3 ? -1.0 / 3.0 + u * u / 30.0 : (std::cos(u) - sinc) / (u * u);
    return {amplitude_ * sinc * sinc, -2.0 * amplitude_ * sinc * slope_per_u * scale * scale};
  }

 private:
  static constexpr double kCin = 2.437653393057226;  // Cin(2 pi), the integral of (1 - cos t)/t to 2 pi

  double radius_, amplitude_;
};

}  // namespace sluice::fluid
