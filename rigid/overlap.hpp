#pragma once

#include "rigid/shape.hpp"

namespace sluice::rigid {

struct Interval {
  double min, max;
};

// The shape's projection on a unit vector: smallest and largest x . direction over its points [m].
Interval extent(const Shape& shape, const Pose& pose, const Eigen::Vector3d& direction, int dimension);

// Smallest distance [m] by which one shape has to move for the two to touch; exact, by separating axes
// (S. Gottschalk, "Separating axis theorem", TR96-024, UNC Chapel Hill 1996). Not positive when they are
// apart; its magnitude is then a lower bound of their distance.
double penetration(const Shape& a, const Pose& pose_a, const Shape& b, const Pose& pose_b, int dimension);

}  // namespace sluice::rigid
