#pragma once

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "fluid/symmetric.hpp"
#include "fluid/types.hpp"

namespace sluice::fluid {

// Sums over the neighbours j of i, itself included, of the weight V_j W_ij:
//   m0 = sum V W,  m1 = sum V W x_ji,  m2 = sum V W x_ji (x) x_ji,  x_ji = x_j - x_i.
template <int Dim>
struct Moments {
  double m0 = 0;
  Vec<Dim> m1 = Vec<Dim>::Zero();
  Mat<Dim> m2 = Mat<Dim>::Zero();

  void add(double weight, const Vec<Dim>& x_ji) {
    m0 += weight;
    m1 += weight * x_ji;
    m2 += weight * x_ji * x_ji.transpose();
  }
};

// The linear moving-least-squares fit at a particle, CF (9) and (14) in centred form. The gradient of the
// local fit (diffuse derivative) and the shape function of neighbour j are
//   grad N_j(x_i) = V_j W_ij (g + G x_ji),      N_j(x_i) = V_j W_ij (1/m0 - m1/m0 . (g + G x_ji)).
// With C = m2 - m1 (x) m1 / m0 the exact fit has G = C^-1 and g = -G m1/m0. Then sum N = 1, sum N x = x,
// sum grad N = 0 and sum x (x) grad N = I, CF (16)-(17).
template <int Dim>
struct Fit {
  Vec<Dim> g;
  Symmetric<Dim> G;
  double m0;
  // Spray: an eigenvalue of C was below the floor, too few neighbours for a linear fit; or wedged.hpp.
  bool floored;
};

// Inverse of a symmetric matrix by its adjugate; Dim is 2 or 3.
template <int Dim>
Mat<Dim> symmetric_inverse(const Mat<Dim>& a) {
  if constexpr (Dim == 2) {
    const double det = a(0, 0) * a(1, 1) - a(0, 1) * a(0, 1);
    Mat<2> inverse;
    inverse << a(1, 1) / det, -a(0, 1) / det, -a(0, 1) / det, a(0, 0) / det;
    return inverse;
  } else {
    const double c00 = a(1, 1) * a(2, 2) - a(1, 2) * a(1, 2);
    const double c01 = a(0, 2) * a(1, 2) - a(0, 1) * a(2, 2);
    const double c02 = a(0, 1) * a(1, 2) - a(0, 2) * a(1, 1);
    const double det = a(0, 0) * c00 + a(0, 1) * c01 + a(0, 2) * c02;
    const double c11 = a(0, 0) * a(2, 2) - a(0, 2) * a(0, 2);
    const double c12 = a(0, 1) * a(0, 2) - a(0, 0) * a(1, 2);
    const double c22 = a(0, 0) * a(1, 1) - a(0, 1) * a(0, 1);
    Mat<3> inverse;
    inverse << c00, c01, c02, c01, c11, c12, c02, c12, c22;
    return inverse / det;
  }
}

// a of the shape functions N_j(x_i) = V_j W_ij (a + g.x_ji): (1 - m1.g)/m0, in which m1/m0 = -G^-1 g.
template <int Dim>
double shape_constant(const Fit<Dim>& fit) {
  return 1.0 / fit.m0 + fit.g.dot(symmetric_inverse<Dim>(fit.G) * fit.g);
}

// Whether every eigenvalue of the symmetric `a` is above `bound`: Sylvester's criterion on a - bound I.
template <int Dim>
bool eigenvalues_above(const Mat<Dim>& a, double bound) {
  const Mat<Dim> b = a - bound * Mat<Dim>::Identity();
  const double minor2 = b(0, 0) * b(1, 1) - b(0, 1) * b(0, 1);
  if (b(0, 0) <= 0.0 || minor2 <= 0.0) return false;
  if constexpr (Dim == 3) return b.determinant() > 0.0;
  return true;
}

// The matrix with the eigenvalues of C raised to at least `floor`, inverted; `floored` says whether that was
// needed. Square roots only, so its bits do not depend on the processor's libm. In the plane, with the mean
// of the eigenvalues l and half their difference r, f(l) = 1/max(l, floor):
//   G = (f(l+r) + f(l-r))/2 I + (f(l+r) - f(l-r))/(2r) (C - l I).
template <int Dim>
Mat<Dim> floored_inverse(const Mat<Dim>& C, double floor, bool& floored) {
  floored = !eigenvalues_above<Dim>(C, floor);
  if (!floored) return symmetric_inverse<Dim>(C);
  if constexpr (Dim == 2) {
    const double mean = 0.5 * (C(0, 0) + C(1, 1)), half = 0.5 * (C(0, 0) - C(1, 1));
    const double r = std::sqrt(half * half + C(0, 1) * C(0, 1));
    const double most = 1.0 / std::max(mean - r, floor), least = 1.0 / std::max(mean + r, floor);
    const double slope = most > least ? 0.5 * (least - most) / r : 0.0;
    return 0.5 * (most + least) * Mat<2>::Identity() + slope * (C - mean * Mat<2>::Identity());
  } else {
    const Eigen::SelfAdjointEigenSolver<Mat<Dim>> eigen(C);
    const Vec<Dim> inverse = eigen.eigenvalues().cwiseMax(floor).cwiseInverse();
    return eigen.eigenvectors() * inverse.asDiagonal() * eigen.eigenvectors().transpose();
  }
}

// The fit from the moments, with the eigenvalues of C raised to at least `floor` [the unit of C], where more
// than a lattice is in the support m0 times as much: an oscillation of the particles has a frequency of up to
// about c0 sqrt(m0 |G|), which the time step must resolve. Whatever G
// becomes, g = -G m1/m0 keeps sum grad N = 0 (linear momentum), and G keeps the eigenvectors of C (a
// pressure then exerts no net moment: angular momentum).
template <int Dim>
Fit<Dim> fit(const Moments<Dim>& m, double floor) {
  const Mat<Dim> C = m.m2 - m.m1 * m.m1.transpose() / m.m0;
  Fit<Dim> f;
  f.G = floored_inverse<Dim>(C, floor * std::max(1.0, m.m0), f.floored);
  f.m0 = m.m0;
  f.g = f.G * (-m.m1 / m.m0);
  return f;
}

}  // namespace sluice::fluid
