#pragma once

#include <Eigen/Geometry>

namespace sluice::rigid {

// State of one body at the end of a step. Velocities are means over the step, so that
// position(end) - position(start) = velocity * dt exactly; world frame, SI.
struct Kinematics {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  // of the centre of mass
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
  Eigen::Vector3d angular_velocity = Eigen::Vector3d::Zero();
  Eigen::Vector3d acceleration = Eigen::Vector3d::Zero();
  Eigen::Vector3d angular_acceleration = Eigen::Vector3d::Zero();
};

// Force [N] and moment about the centre of mass [N m], world frame.
struct Wrench {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
};

}  // namespace sluice::rigid
