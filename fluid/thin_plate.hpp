#pragma once

#include <algorithm>
#include <limits>

#include "fluid/boundary.hpp"

namespace sluice::fluid {

// The thin-plate rule (README.md): the two sides of a plate thinner than two supports must not see each
// other.

// The face that fluid at x, pressed into the plate, belongs to: the nearest that it can have come through. -1
// when x is outside.
template <int Dim>
int home_face(const Plate<Dim>& plate, const Vec<Dim>& x) {
  int nearest = -1;
  double largest = -std::numeric_limits<double>::infinity();
  for (std::size_t f = 0; f < plate.faces.size(); ++f) {
    const double d = plate.faces[f].distance(x);
    if (d > 0.0) return -1;
    if (d > largest && !plate.is_covered[f]) {
      largest = d;
      nearest = static_cast<int>(f);
    }
  }
  return nearest;
}

// Whether fluid at x sees the boundary particles of that face: it stands in front of it, or inside and at
// home there.
template <int Dim>
bool sees_face(const Plate<Dim>& plate, int face, const Vec<Dim>& x) {
  return plate.faces[static_cast<std::size_t>(face)].distance(x) > 0.0 || home_face(plate, x) == face;
}

// Whether the segment between two points outside passes through the plate: clips it by the half-spaces behind
// the faces (M. Cyrus, J. Beck, Computers & Graphics 3, 1978). From x to y and back the answer is the same to
// the last bit.
template <int Dim>
bool crosses(const Plate<Dim>& plate, const Vec<Dim>& x, const Vec<Dim>& y) {
  const bool forward = std::lexicographical_compare(x.begin(), x.end(), y.begin(), y.end());
  const Vec<Dim>& from = forward ? x : y;
  const Vec<Dim>& to = forward ? y : x;
  double enter = 0.0, leave = 1.0;
  for (const Plane<Dim>& face : plate.faces) {
    const double d0 = face.distance(from), d1 = face.distance(to);
    if (d0 > 0.0 && d1 > 0.0) return false;
    if (d0 > 0.0) enter = std::max(enter, d0 / (d0 - d1));
    if (d1 > 0.0) leave = std::min(leave, d0 / (d0 - d1));
  }
  return enter < leave;
}

// Whether the plate stands between two fluid particles. One that is pressed into a face stays with that
// face's side.
template <int Dim>
bool separates(const Plate<Dim>& plate, const Vec<Dim>& x, const Vec<Dim>& y) {
  if (const int home = home_face(plate, x); home >= 0) return !sees_face(plate, home, y);
  if (const int home = home_face(plate, y); home >= 0) return !sees_face(plate, home, x);
  return crosses(plate, x, y);
}

// Whether x is not further than `reach` in front of any face of the plate: only pairs with both ends so,
// `reach` being their length, can be affected by it.
template <int Dim>
bool is_near(const Plate<Dim>& plate, const Vec<Dim>& x, double reach) {
  return std::all_of(plate.faces.begin(), plate.faces.end(),
                     [&](const Plane<Dim>& face) { return face.distance(x) < reach; });
}

}  // namespace sluice::fluid
