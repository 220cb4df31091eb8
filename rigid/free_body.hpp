#pragma once

#include "rigid/kinematics.hpp"
#include "rigid/world.hpp"

namespace sluice::rigid {

// State and kicks of a free body. Rotation is held as angular momentum, which a free drift leaves alone.
class FreeBody {
 public:
  FreeBody(const BodySpec& spec, const Eigen::Vector3d& gravity, int dimension);

  // V += dt (F/m + g), L += dt T, with the last wrench and load.
  void kick(double dt);
  void set_wrench(const Wrench& wrench);
  // Of springs and dampers.
  void set_load(const Wrench& load);

  // Impulses of joints [N s], [N m s]. Noted: all since the last `forget` count as the acceleration by joints
  // over a drift of dt.
  void apply_joint(const Wrench& impulse);
  void note_joint_impulse(double dt);
  void forget_joint_impulse() { joint_impulse_ = {}; }
  struct Response {
    Eigen::Vector3d velocity, angular_velocity;
  };
  // What an impulse changes of the velocities.
  [[nodiscard]] Response response(const Wrench& impulse) const;
  // Adds momentum [N s] and angular momentum [N m s].
  void push(const Wrench& impulse);

  // The constant angular velocity that carries the body through a drift of dt: that of the half-turned body.
  [[nodiscard]] Eigen::Vector3d drift_angular_velocity(double dt) const;

  // What a drift did: from start pose, velocity and drift angular velocity to those after contact.
  struct Drift {
    Pose pose;
    Eigen::Vector3d velocity, angular_velocity;
    Eigen::Vector3d acceleration = Eigen::Vector3d::Zero();  // by the last forces [m/s^2]
  };
  // Takes over the result of a drift that began with `before` and gives the kinematics of the step.
  Kinematics finish_drift(double dt, const Drift& before, const Drift& after);

  [[nodiscard]] Drift begin_drift(double dt) const {
    return {pose_, velocity_, drift_angular_velocity(dt), acceleration()};
  }
  // Where a drift of dt leads, with that added to its velocities.
  [[nodiscard]] Pose drifted(double dt, const Eigen::Vector3d& velocity, const Eigen::Vector3d& turn) const;
  [[nodiscard]] const Pose& pose() const { return pose_; }
  [[nodiscard]] Kinematics state() const;
  [[nodiscard]] double kinetic_energy() const;
  // 1 along and about the world axes where the body may move and turn, 0 elsewhere.
  [[nodiscard]] const Eigen::Vector3d& free_axes() const { return free_axes_; }
  [[nodiscard]] const Eigen::Vector3d& free_turns() const { return free_turns_; }
  [[nodiscard]] Account account() const;
  // That of a body at rest after this impulse [J].
  [[nodiscard]] double impulse_energy(const Wrench& impulse) const;
  [[nodiscard]] double mass() const { return mass_; }
  // In the body's frame [kg m^2].
  [[nodiscard]] const Eigen::Matrix3d& inertia() const { return inertia_; }

  // All that changes in a run, for state_numbers.hpp.
  template <typename Visitor>
  void visit_state(Visitor& visitor) {
    visitor.visit_all(wrench_, load_, joint_impulse_, by_joints_, turned_by_joints_, pose_, velocity_,
                      angular_momentum_, constraint_impulse_, constraint_work_, contact_, angular_contact_);
  }

 private:
  // Of contact, joints, springs and dampers: an impulse and the work that it did [J].
  void account_constraint(const Wrench& impulse, double work);
  // Angular velocity times inertia.
  [[nodiscard]] Eigen::Vector3d angular_momentum(const Eigen::Quaterniond& orientation,
                                                 const Eigen::Vector3d& angular_velocity) const;
  // The inverse, about the axes that are free.
  [[nodiscard]] Eigen::Vector3d turn_of(const Eigen::Quaterniond& orientation,
                                        const Eigen::Vector3d& angular_momentum) const;
  [[nodiscard]] Eigen::Vector3d angular_velocity(const Eigen::Quaterniond& orientation) const {
    return turn_of(orientation, angular_momentum_);
  }
  [[nodiscard]] Eigen::Vector3d angular_acceleration() const;
  [[nodiscard]] Eigen::Vector3d acceleration() const {
    return (wrench_.force + load_.force) / mass_ + gravity_;
  }

  double mass_;
  Eigen::Matrix3d inertia_, inverse_inertia_;  // body frame; the inverse is not read where an axis is locked
  Eigen::Vector3d gravity_;
  Eigen::Vector3d free_axes_, free_turns_;
  Wrench wrench_, load_;
  Wrench joint_impulse_;
  Eigen::Vector3d by_joints_ = Eigen::Vector3d::Zero(), turned_by_joints_ = Eigen::Vector3d::Zero();

  Pose pose_;
  Eigen::Vector3d velocity_, angular_momentum_;
  Wrench constraint_impulse_;
  double constraint_work_ = 0;
  // Accelerations by contact in the last drift.
  Eigen::Vector3d contact_ = Eigen::Vector3d::Zero(), angular_contact_ = Eigen::Vector3d::Zero();
};

}  // namespace sluice::rigid
