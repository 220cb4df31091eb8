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

// What one cause gave to a body since the start.
struct Given {
  Wrench impulse;   // [N s], [N m s]
  double work = 0;  // of it [J]
};

// What a free body has and what gave it that, besides the fluid and gravity. Moments about the centre of
// mass.
struct Account {
  Wrench momentum;  // [kg m/s] and angular [kg m^2/s]
  Given contact;
  Given joints;               // springs and dampers among them
  Given drive;                // of what holds locked axes and drives those that a motion prescribes
  double kinetic_energy = 0;  // [J]
  double mass = 0;            // [kg]
};

}  // namespace sluice::rigid
