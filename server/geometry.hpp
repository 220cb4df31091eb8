#pragma once

#include "fluid/kinematics.hpp"
#include "fluid/shape.hpp"
#include "scene.pb.h"

namespace sluice::server {

// A repeated field as a vector; missing entries are zero.
Eigen::Vector3d to_vector(const google::protobuf::RepeatedField<double>& entries);

// A region of liquid: its shape about its own origin and where that stands [m].
struct Region {
  fluid::Shape shape;
  Eigen::Vector3d center;
};
Region to_region(const FluidRegion& region);

// A body's shape about its centre of mass.
fluid::Shape to_shape(const Body& body, int dimension);

// Given, or of a homogeneous body [kg]; per metre of depth in two dimensions.
double mass(const Body& body, int dimension);

// Pose of a body at time 0; the velocity of a free one.
fluid::Kinematics initial_kinematics(const Body& body, int dimension);

// Distance [m] of x from the surface of a body in its pose, negative inside.
double distance(const fluid::Shape& shape, const fluid::Kinematics& pose, const Eigen::Vector3d& x,
                int dimension);

// Whether x is within all sides of the tank, open ones too.
bool is_inside_tank(const Scene& scene, const Eigen::Vector3d& x);

// Largest value of direction.x over a region's shape about its own origin [m].
double support(const fluid::Shape& shape, const Eigen::Vector3d& direction);

}  // namespace sluice::server
