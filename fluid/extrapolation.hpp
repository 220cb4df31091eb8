#pragma once

#include "fluid/moments.hpp"

namespace sluice::fluid {

// Inverse covariance [1/m^2] of the positions in `moments`, whose variances are kept above `floor` [m^2].
template <int Dim>
Mat<Dim> inverse_covariance(const Moments<Dim>& moments, double floor) {
  return fit<Dim>({1.0, moments.m1 / moments.m0, moments.m2 / moments.m0}, floor).G;
}

// Weighted linear fit of N values of the fluid near a boundary particle: their mean, which belongs to the
// centroid of that fluid, and their slope. Only fluid enters: with boundary particles among the data, what
// they were given before would confirm itself.
template <int Dim, int N>
class Extrapolation {
 public:
  using Values = Eigen::Matrix<double, N, 1>;
  using Slope = Eigen::Matrix<double, N, Dim>;

  Extrapolation() = default;
  // From the sums of W, of W values and of W values (x) x_fw.
  Extrapolation(const Moments<Dim>& moments, const Values& sum, const Slope& sum_x)
      : moments_(moments), sum_(sum), sum_x_(sum_x) {}

  // A fluid particle at x_fw from the boundary particle.
  void add(double W, const Vec<Dim>& x_fw, const Values& values) {
    moments_.add(W, x_fw);
    sum_ += W * values;
    sum_x_ += W * values * x_fw.transpose();
  }

  [[nodiscard]] bool empty() const { return !(moments_.m0 > 0.0); }
  [[nodiscard]] double weight() const { return moments_.m0; }
  [[nodiscard]] Values mean() const { return sum_ / moments_.m0; }
  [[nodiscard]] Vec<Dim> centroid() const { return moments_.m1 / moments_.m0; }

  // The variances of the positions are kept above `floor` [m^2], so that little data gives a small slope.
  [[nodiscard]] Slope slope(double floor) const {
    return (sum_x_ / moments_.m0 - mean() * centroid().transpose()) *
           inverse_covariance<Dim>(moments_, floor);
  }

 private:
  Moments<Dim> moments_;
  Values sum_ = Values::Zero();
  Slope sum_x_ = Slope::Zero();
};

}  // namespace sluice::fluid
