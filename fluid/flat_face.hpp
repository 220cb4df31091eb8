#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "fluid/setup.hpp"
#include "fluid/shape.hpp"

namespace sluice::fluid {

// A flat face of a box or of a convex polygon: its points are origin + a e1 + b e2 with 0 <= a <= length1 and
// 0 <= b <= length2. Its layers of boundary particles go along -normal, from a lattice of feet on it.
struct FlatFace {
  Eigen::Vector3d origin, e1, e2, normal;
  double length1, length2;  // [m]; length2 is 0 in two dimensions

  [[nodiscard]] double distance(const Eigen::Vector3d& x) const { return (x - origin).dot(normal); }
  // Whether the foot of x on the plane is on the face, or within `margin` [m] of it.
  [[nodiscard]] bool is_above(const Eigen::Vector3d& x, double margin) const {
    const double a = (x - origin).dot(e1), b = (x - origin).dot(e2);
    return a > -margin && a < length1 + margin && b > -margin && b < length2 + margin;
  }
  [[nodiscard]] FlatFace in(const PlacedShape& place) const {
    const Eigen::Quaterniond& R = place.orientation;
    return {place.position + R * origin, R * e1, R * e2, R * normal, length1, length2};
  }
};

// Of a shape that the thin-plate rule knows; none of the others.
std::vector<FlatFace> flat_faces(const Shape& shape, int dimension);

// The feet of a face's layers: n1 x n2 cells that fit it. Places beyond the face have indices, too.
struct Feet {
  Feet(const FlatFace& flat, double spacing)
      : face(flat),
        n1(std::max(1, static_cast<int>(std::lround(flat.length1 / spacing)))),
        n2(std::max(1, static_cast<int>(std::lround(flat.length2 / spacing)))),
        d1(flat.length1 / n1),
        d2(flat.length2 / n2) {}

  [[nodiscard]] Eigen::Vector3d at(int a, int b) const {
    return face.origin + (a + 0.5) * d1 * face.e1 + (b + 0.5) * d2 * face.e2;
  }
  [[nodiscard]] bool has(int a, int b) const { return a >= 0 && a < n1 && b >= 0 && b < n2; }
  [[nodiscard]] double area() const { return d1 * (face.length2 > 0 ? d2 : 1.0); }

  FlatFace face;
  int n1, n2;
  double d1, d2;  // [m]
};

}  // namespace sluice::fluid
