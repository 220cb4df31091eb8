#pragma once

#include <Eigen/Geometry>

namespace sluice::fluid {

// Motion of one body over a step, as the solver needs it. World frame, SI. In two dimensions only
// x, y and rotation about z are read.
struct Kinematics {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();               // of the centre of mass, end of the step
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();  // end of the step
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();               // mean over the step
  Eigen::Vector3d angular_velocity = Eigen::Vector3d::Zero();       // mean over the step
  Eigen::Vector3d acceleration = Eigen::Vector3d::Zero();           // end of the step
  Eigen::Vector3d angular_acceleration = Eigen::Vector3d::Zero();   // end of the step

  // To the last bit.
  bool operator==(const Kinematics& other) const {
    return position == other.position && orientation.coeffs() == other.orientation.coeffs() &&
           velocity == other.velocity && angular_velocity == other.angular_velocity &&
           acceleration == other.acceleration && angular_acceleration == other.angular_acceleration;
  }
};

// Force [N] and moment about the centre of mass [N m]; per metre of depth in two dimensions.
struct Wrench {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
};

// What the force on a body consists of; the sum is the wrench. Viscous and pressure parts are told apart by
// the default operator only, all else counts as pressure.
struct WrenchParts {
  Wrench pressure, viscous;
  Wrench guard;  // springs against penetration
};

}  // namespace sluice::fluid
