#include "validation/support/oscillation.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <stdexcept>

namespace sluice::validation {

namespace {

using Parameters = Eigen::Matrix<double, 5, 1>;  // decay, frequency, cosine, sine, offset

// Gauss-Newton: the step that solves the linearised least-squares problem.
Parameters improvement(const Curve& curve, const Parameters& p) {
  const auto n = static_cast<Eigen::Index>(curve.x.size());
  Eigen::Matrix<double, Eigen::Dynamic, 5> jacobian(n, 5);
  Eigen::VectorXd residual(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const double t = curve.x[static_cast<std::size_t>(k)];
    const double left = std::exp(-p[0] * t), c = std::cos(p[1] * t), s = std::sin(p[1] * t);
    const double swing = left * (p[2] * c + p[3] * s);
    jacobian.row(k) << -t * swing, t * left * (p[3] * c - p[2] * s), left * c, left * s, 1;
    residual[k] = curve.y[static_cast<std::size_t>(k)] - swing - p[4];
  }
  return jacobian.colPivHouseholderQr().solve(residual);
}

}  // namespace

Oscillation fit_oscillation(const Curve& curve, const Oscillation& start) {
  constexpr int kMostSteps = 50;
  constexpr double kConverged = 1e-10;
  Parameters p;
  p << start.decay, start.frequency, start.cosine, start.sine, start.offset;
  for (int step = 0; step < kMostSteps; ++step) {
    const Parameters change = improvement(curve, p);
    p += change;
    if (!p.allFinite()) break;
    if (change.norm() <= kConverged * p.norm())
      return {.frequency = p[1], .decay = p[0], .cosine = p[2], .sine = p[3], .offset = p[4]};
  }
  throw std::runtime_error("no damped oscillation fits the curve");
}

}  // namespace sluice::validation
