#pragma once

#include <limits>

#include "fluid/boundary.hpp"

namespace sluice::fluid {

// The thin-plate rule (README.md): the two sides of a plate thinner than two supports must not see each
// other.

// Whether fluid at x sees the boundary particles of that face: it stands in front of the face, or it is
// inside the plate and this is the face nearest to it.
template <int Dim>
bool sees_face(const Plate<Dim>& plate, std::size_t face, const Vec<Dim>& x) {
  if (plate.faces[face].distance(x) > 0.0) return true;
  std::size_t nearest = 0;
  double largest = -std::numeric_limits<double>::infinity();
  for (std::size_t f = 0; f < plate.faces.size(); ++f) {
    const double d = plate.faces[f].distance(x);
    if (d > 0.0) return false;
    if (d > largest) {
      largest = d;
      nearest = f;
    }
  }
  return nearest == face;
}

// Whether the segment from x to y passes through the plate: clips it by the half-spaces behind the faces
// (M. Cyrus, J. Beck, Computers & Graphics 3, 1978).
template <int Dim>
bool separates(const Plate<Dim>& plate, const Vec<Dim>& x, const Vec<Dim>& y) {
  double enter = 0.0, leave = 1.0;
  for (const Plane<Dim>& face : plate.faces) {
    const double dx = face.distance(x), dy = face.distance(y);
    if (dx > 0.0 && dy > 0.0) return false;
    if (dx > 0.0) enter = std::max(enter, dx / (dx - dy));
    if (dy > 0.0) leave = std::min(leave, dx / (dx - dy));
  }
  return enter < leave;
}

// Whether a pair with an end at x can be affected by the plate.
template <int Dim>
bool is_near(const Plate<Dim>& plate, const Vec<Dim>& x, double reach) {
  const double limit = plate.radius + reach;
  return (x - plate.center).squaredNorm() < limit * limit;
}

}  // namespace sluice::fluid
