#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sluice::fluid {

// Wendland's C2 kernel with support radius 2h (H. Wendland, Adv. Comput. Math. 4, 1995):
//   W(r) = A (1 - q/2)^4 (2q + 1),  q = r/h,  A = 7/(4 pi h^2) in 2D, 21/(16 pi h^3) in 3D [1/m^Dim]
//   F(r) = -W'(r)/r = 5 A/h^2 (1 - q/2)^3,  so that grad W(x_i - x_j) = -F x_ij.
// Beyond the support both are exactly zero.
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

  // W from the squared distance.
  [[nodiscard]] double value(double r2) const {
    const double half_q = std::sqrt(r2) * half_inverse_h_;
    const double u = std::max(0.0, 1.0 - half_q);
    const double u2 = u * u;
    return amplitude_ * u2 * u2 * (4.0 * half_q + 1.0);
  }

  struct ValueAndSlope {
    double w, f;
  };
  // W and F from the squared distance.
  [[nodiscard]] ValueAndSlope value_and_slope(double r2) const {
    const double half_q = std::sqrt(r2) * half_inverse_h_;
    const double u = std::max(0.0, 1.0 - half_q);
    const double u3 = u * u * u;
    return {amplitude_ * u3 * u * (4.0 * half_q + 1.0), slope_ * u3};
  }

 private:
  double h_, half_inverse_h_, amplitude_, slope_;
};

}  // namespace sluice::fluid
