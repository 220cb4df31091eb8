#pragma once

#include "rigid/kinematics.hpp"
#include "rigid/world.hpp"

namespace sluice::rigid {

// State and kicks of a free body. Rotation is held as angular momentum, which a free drift leaves alone.
// Along and about axes that are not free it is at rest, or goes as the motion says that guides it.
class FreeBody {
 public:
  FreeBody(const BodySpec& spec, const Eigen::Vector3d& gravity, int dimension);

  // Of a guided body. A step from one offset of its motion to another begins: until it ends the body has the
  // mean velocities between them.
  void set_off(const Offset& start, const Offset& end, double dt);
  // The step ends where the motion is by then, with the motion's velocities.
  void arrive(const BodySpec& spec, const Offset& end);
  // From now on the motion does not guide it, and only the axes that are locked are not free.
  void let_go(const BodySpec& spec);
  [[nodiscard]] bool is_guided() const { return is_guided_; }

  // V += dt (F/m + g), L += dt T, with the last wrench and load.
  void kick(double dt);
  void set_wrench(const Wrench& wrench);
  // Of springs and dampers.
  void set_load(const Wrench& load);

  // A step begins.
  void begin_step();
  // Impulses of joints [N s], [N m s]. Where a limit is hit energy is lost. Noted: all since the step began
  // count as the acceleration by joints over a drift of dt.
  void apply_joint(const Wrench& impulse, bool is_hit);
  void note_joint_impulse(double dt);
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
    visitor.visit_all(wrench_, blocked_, load_, joint_impulse_, by_joints_, turned_by_joints_, pose_,
                      velocity_, angular_momentum_, guide_turn_, guide_mean_.force, guide_mean_.moment,
                      guide_acceleration_, guide_angular_acceleration_, by_contact_.impulse, by_contact_.work,
                      joined_.impulse, joined_.work, driven_.impulse, driven_.work, held_, contact_,
                      angular_contact_);
  }

 private:
  // The axes that are not free.
  void set_held(const std::array<bool, 3>& axes, const std::array<bool, 3>& turns);
  // Only what is along and about free axes, or only what is not.
  [[nodiscard]] Wrench on_free_axes(const Wrench& wrench) const;
  [[nodiscard]] Wrench on_held_axes(const Wrench& wrench) const;
  void push_free(const Wrench& impulse);
  void account_joint(const Wrench& impulse);
  // Velocities along and about the axes that are not free.
  void guide(const Eigen::Vector3d& velocity, const Eigen::Vector3d& turn);
  // How the momentum along and about them changed since this was asked last.
  Wrench held_change();
  // What holds them took up this impulse and gave the change of their momentum.
  void account_held(const Wrench& taken);
  [[nodiscard]] Wrench momentum() const;
  // Angular velocity times inertia.
  [[nodiscard]] Eigen::Vector3d angular_momentum(const Eigen::Quaterniond& orientation,
                                                 const Eigen::Vector3d& angular_velocity) const;
  // The inverse, about the axes that are free.
  [[nodiscard]] Eigen::Vector3d turn_of(const Eigen::Quaterniond& orientation,
                                        const Eigen::Vector3d& angular_momentum) const;
  [[nodiscard]] Eigen::Vector3d angular_velocity(const Eigen::Quaterniond& orientation) const;
  [[nodiscard]] Eigen::Vector3d angular_acceleration() const;
  [[nodiscard]] Eigen::Vector3d free_acceleration() const {
    return (wrench_.force + load_.force) / mass_ + free_axes_.cwiseProduct(gravity_);
  }
  [[nodiscard]] Eigen::Vector3d acceleration() const { return free_acceleration() + guide_acceleration_; }

  double mass_;
  Eigen::Matrix3d inertia_, inverse_inertia_;  // body frame; the inverse of three dimensions only
  Eigen::Vector3d gravity_;
  int dimension_;
  bool is_guided_, is_held_ = false;  // by a motion; along or about any axis
  Eigen::Vector3d free_axes_, free_turns_;
  Wrench wrench_, blocked_;  // of the liquid's, along and about free axes and the others
  Wrench load_;
  Wrench joint_impulse_;
  // Forces work on the way of a step's drift, as those of the fluid are counted: what joints, springs and
  // dampers gave before it, what of that is by stops, and the velocities before the step and of its drift.
  // Nothing of it lasts from step to step.
  Wrench before_drift_, hits_, start_velocity_, drift_velocity_;
  bool is_before_drift_ = true;
  Eigen::Vector3d by_joints_ = Eigen::Vector3d::Zero(), turned_by_joints_ = Eigen::Vector3d::Zero();

  Pose pose_;
  Eigen::Vector3d velocity_;
  Eigen::Vector3d angular_momentum_;  // about free axes
  // What the motion gives: about axes that are not free, now; force and moment stand for the mean velocities
  // of the step; accelerations at its end.
  Eigen::Vector3d guide_turn_ = Eigen::Vector3d::Zero();
  Wrench guide_mean_;
  Eigen::Vector3d guide_acceleration_ = Eigen::Vector3d::Zero(),
                  guide_angular_acceleration_ = Eigen::Vector3d::Zero();
  Given by_contact_, joined_, driven_;
  Wrench held_;  // momentum along and about axes that are not free
  // Accelerations by contact in the last drift.
  Eigen::Vector3d contact_ = Eigen::Vector3d::Zero(), angular_contact_ = Eigen::Vector3d::Zero();
};

}  // namespace sluice::rigid
