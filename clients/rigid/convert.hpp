#pragma once

#include "rigid/world.hpp"
#include "scene.pb.h"

// From the scene's messages to the rigid library's types. The scene has passed the checks of its fields and
// has its defaults filled in (protocol/scene_check.hpp).
namespace sluice::clients {

// Missing entries are zero.
Eigen::Vector3d to_vector(const google::protobuf::RepeatedField<double>& entries);

// About the body's centre of mass. Throws std::invalid_argument for a body without a shape.
rigid::Shape to_shape(const Body& body, int dimension);
rigid::Pose initial_pose(const Body& body, int dimension);
// The body's prescribed motion. Throws rigid::MotionError; its part is the path of the field below
// `prescribed`, such as "expression.x".
rigid::MotionPtr to_motion(const Body& body, int dimension);

rigid::Tank to_tank(const Domain& domain, int dimension);

// Throws std::invalid_argument naming the body.
rigid::WorldSpec to_world(const Scene& scene);

}  // namespace sluice::clients
