#pragma once

#include <algorithm>

namespace sluice::clients {

// The share of a residual r that the next guess takes up (B. Irons, R. Tuck, Int. J. Numer. Methods Eng. 1,
// 1969):  omega' = -omega <r_old, r - r_old> / <r - r_old, r - r_old>.
class Aitken {
 public:
  explicit Aitken(double omega) : omega_(omega) {}

  // Of the next guess, after two guesses in a row. Where the residual did not change there is nothing to
  // learn.
  double update(double old_dot_change, double change_dot_change) {
    if (change_dot_change > 0.0)
      omega_ = std::clamp(-omega_ * old_dot_change / change_dot_change, kSmallest, kLargest);
    return omega_;
  }
  [[nodiscard]] double omega() const { return omega_; }
  void set_omega(double omega) { omega_ = omega; }

 private:
  // The liquid resists: the answer falls as the guess rises, and the share lies between 0 and 1. A negative
  // one, from noise, would go the wrong way.
  static constexpr double kSmallest = 1e-3, kLargest = 1.0;

  double omega_;
};

}  // namespace sluice::clients
