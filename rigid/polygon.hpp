#pragma once

#include <Eigen/Core>
#include <vector>

// Integrals over simple polygons, counter-clockwise [m]. By Green's theorem each is a sum over edges (a, b)
// of a x b times a polynomial: C. Steger, "On the calculation of arbitrary moments of polygons", report
// FGBV-96-05, TU Munich 1996, eqs. for alpha_00, alpha_10, alpha_20 and alpha_02.
namespace sluice::rigid {

using Vertices = std::vector<Eigen::Vector2d>;

[[nodiscard]] inline double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

// Negative for clockwise polygons.
double area(const Vertices& vertices);
Eigen::Vector2d centroid(const Vertices& vertices);
// Whether no corner turns to the right.
bool is_convex(const Vertices& vertices);
// Integral of |x|^2 about the origin [m^4].
double polar_moment(const Vertices& vertices);

}  // namespace sluice::rigid
