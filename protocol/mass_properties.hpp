#pragma once

#include <Eigen/Core>

#include "scene.pb.h"

namespace sluice::protocol {

// Moments of a homogeneous body of density 1 about a frame's origin: volume, integrals of x and of x x^T;
// area instead of volume in two dimensions [m], [m^2] ...
struct Moments {
  double volume = 0;
  Eigen::Vector3d first = Eigen::Vector3d::Zero();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
};

// Of a body's shape in the frame that it is given in; the parts of a compound by their densities over the
// body's.
Moments moments(const Body& body, int dimension);

// A body's mass [kg], centre of mass in the frame of its shape [m], and inertia about it, along the axes of
// that frame [kg m^2]; in two dimensions per metre of depth, with nothing but zz.
struct MassProperties {
  double mass = 0;
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
};

// What the body's fields give, the rest from the homogeneous shape; mass 0 of a body without any. Both
// processes take them from here.
MassProperties mass_properties(const Body& body, int dimension);

}  // namespace sluice::protocol
