#pragma once

#include "rigid/kinematics.hpp"
#include "rigid/world.hpp"

namespace sluice::rigid {

// State and kicks of a free body. Rotation is held as angular momentum, which a free drift leaves alone.
class FreeBody {
 public:
  FreeBody(const BodySpec& spec, const Eigen::Vector3d& gravity, int dimension);

  // V += dt (F/m + g), L += dt T, with the last wrench.
  void kick(double dt);
  void set_wrench(const Wrench& wrench);
  // Adds momentum [N s] and angular momentum [N m s].
  void push(const Wrench& impulse);

  // The constant angular velocity that carries the body through a drift of dt: that of the half-turned body.
  [[nodiscard]] Eigen::Vector3d drift_angular_velocity(double dt) const;

  // What a drift did: from start pose, velocity and drift angular velocity to those after contact.
  struct Drift {
    Pose pose;
    Eigen::Vector3d velocity, angular_velocity;
  };
  // Takes over the result of a drift that began with `before` and gives the kinematics of the step.
  Kinematics finish_drift(double dt, const Drift& before, const Drift& after);

  [[nodiscard]] Drift begin_drift(double dt) const { return {pose_, velocity_, drift_angular_velocity(dt)}; }
  [[nodiscard]] Kinematics state() const;
  [[nodiscard]] double kinetic_energy() const;
  [[nodiscard]] Account account() const;
  // That of a body at rest after this impulse [J].
  [[nodiscard]] double impulse_energy(const Wrench& impulse) const;
  [[nodiscard]] double mass() const { return mass_; }
  [[nodiscard]] const Eigen::Vector3d& inertia() const { return inertia_; }

 private:
  [[nodiscard]] Eigen::Vector3d angular_velocity(const Eigen::Quaterniond& orientation) const;
  [[nodiscard]] Eigen::Vector3d angular_acceleration() const;
  [[nodiscard]] Eigen::Vector3d acceleration() const { return wrench_.force / mass_ + gravity_; }

  double mass_;
  Eigen::Vector3d inertia_, inverse_inertia_;  // principal, body frame; zeros lock an axis
  Eigen::Vector3d gravity_;
  Eigen::Vector3d free_axes_, free_turns_;  // 1 where the body may move and turn, 0 elsewhere
  Wrench wrench_;

  Pose pose_;
  Eigen::Vector3d velocity_, angular_momentum_;
  Wrench constraint_impulse_;
  double constraint_work_ = 0;
  // Accelerations by contact in the last drift.
  Eigen::Vector3d contact_ = Eigen::Vector3d::Zero(), angular_contact_ = Eigen::Vector3d::Zero();
};

}  // namespace sluice::rigid
