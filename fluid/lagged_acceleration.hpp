#pragma once

#include "fluid/kinematics.hpp"

namespace sluice::fluid {

// The acceleration of a body as the pressure of its boundary particles sees it. Of a prescribed motion it is
// the present one. That of a free body answers to the very pressure that it sets, one step late: a body
// lighter than the liquid that its boundary particles stand in for would be thrown to and fro with growing
// amplitude, whatever the time step (the added-mass instability: P. Causin, J. Gerbeau, F. Nobile, Comput.
// Methods Appl. Mech. Eng. 194, 2005). It is averaged over the time in which sound crosses ten supports,
// which is short against all motion of the liquid; stable down to a hundredth of that liquid's mass.
class LaggedAcceleration {
 public:
  LaggedAcceleration(bool is_free, double acoustic_time)
      : time_(is_free ? kAcousticTimes * acoustic_time : 0.0) {}

  // Puts the averages in the place of the accelerations; dt [s] has passed, or 0 at the start.
  void replace(Kinematics& kinematics, double dt) {
    const double share = time_ > 0.0 && dt > 0.0 ? dt / (dt + time_) : 1.0;
    linear_ += share * (kinematics.acceleration - linear_);
    angular_ += share * (kinematics.angular_acceleration - angular_);
    kinematics.acceleration = linear_;
    kinematics.angular_acceleration = angular_;
  }

 private:
  static constexpr double kAcousticTimes = 20.0;  // h/c0; a support is 2h

  double time_;                                        // [s]
  Eigen::Vector3d linear_ = Eigen::Vector3d::Zero();   // [m/s^2]
  Eigen::Vector3d angular_ = Eigen::Vector3d::Zero();  // [rad/s^2]
};

}  // namespace sluice::fluid
