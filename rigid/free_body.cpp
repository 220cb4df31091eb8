#include "rigid/free_body.hpp"

#include <cmath>

namespace sluice::rigid {
namespace {

// The part of `now` that was there a step ago too: what holds a resting body, without the jolt of an impact.
Eigen::Vector3d lasting(const Eigen::Vector3d& before, const Eigen::Vector3d& now) {
  return before.binaryExpr(now, [](double a, double b) {
    if (a * b <= 0) return 0.0;
    return std::abs(a) < std::abs(b) ? a : b;
  });
}

Eigen::Vector3d unlocked(const std::array<bool, 3>& locked, Eigen::Vector3d axes) {
  for (int a = 0; a < 3; ++a)
    if (locked[static_cast<std::size_t>(a)]) axes[a] = 0;
  return axes;
}

Eigen::Matrix3d homogeneous_inertia(const BodySpec& spec, int dimension) {
  const Solid homogeneous = solid(spec.shape, dimension);
  return (spec.mass / homogeneous.volume * homogeneous.inertia).asDiagonal();
}

Eigen::Vector3d rotation_vector(const Eigen::Quaterniond& q) {
  const double sine = q.vec().norm();
  if (sine == 0) return Eigen::Vector3d::Zero();
  const double sign = q.w() < 0 ? -1 : 1;
  return 2 * std::atan2(sine, sign * q.w()) / sine * sign * q.vec();
}

// Contact moves penetrating bodies apart besides their velocity; below this it is round-off [m], [rad].
constexpr double kRoundOff = 1e-13;
Eigen::Vector3d above_round_off(const Eigen::Vector3d& v, double scale) {
  return v.norm() > kRoundOff * (1 + scale) ? v : Eigen::Vector3d(Eigen::Vector3d::Zero());
}

}  // namespace

FreeBody::FreeBody(const BodySpec& spec, const Eigen::Vector3d& gravity, int dimension)
    : mass_(spec.mass), gravity_(gravity), pose_(spec.pose), velocity_(spec.velocity) {
  const double space = dimension == 3 ? 1 : 0;
  free_axes_ = unlocked(spec.locked, {1, 1, space});
  free_turns_ = unlocked(spec.locked_rotation, {space, space, 1});
  inertia_ = spec.inertia ? *spec.inertia : homogeneous_inertia(spec, dimension);
  if (free_turns_ == Eigen::Vector3d::Ones()) inverse_inertia_ = inertia_.inverse();
  gravity_ = gravity_.cwiseProduct(free_axes_);
  velocity_ = velocity_.cwiseProduct(free_axes_);
  angular_momentum_ = angular_momentum(pose_.orientation, spec.angular_velocity.cwiseProduct(free_turns_))
                          .cwiseProduct(free_turns_);
}

void FreeBody::set_wrench(const Wrench& wrench) {
  wrench_.force = wrench.force.cwiseProduct(free_axes_);
  wrench_.moment = wrench.moment.cwiseProduct(free_turns_);
}

void FreeBody::set_load(const Wrench& load) {
  load_.force = load.force.cwiseProduct(free_axes_);
  load_.moment = load.moment.cwiseProduct(free_turns_);
}

void FreeBody::kick(double dt) {
  const Eigen::Vector3d velocity = velocity_, turn = angular_velocity(pose_.orientation);
  velocity_ += dt * acceleration();
  angular_momentum_ += dt * (wrench_.moment + load_.moment);
  const Eigen::Vector3d way = 0.5 * (velocity + velocity_);
  const Eigen::Vector3d turned = 0.5 * (turn + angular_velocity(pose_.orientation));
  account_constraint({dt * load_.force, dt * load_.moment},
                     dt * (load_.force.dot(way) + load_.moment.dot(turned)));
}

void FreeBody::apply_joint(const Wrench& impulse) {
  const double before = kinetic_energy();
  push(impulse);
  joint_impulse_.force += impulse.force;
  joint_impulse_.moment += impulse.moment;
  account_constraint(impulse, kinetic_energy() - before);
}

void FreeBody::account_constraint(const Wrench& impulse, double work) {
  constraint_impulse_.force += impulse.force.cwiseProduct(free_axes_);
  constraint_impulse_.moment += impulse.moment.cwiseProduct(free_turns_);
  constraint_work_ += work;
}

void FreeBody::push(const Wrench& impulse) {
  velocity_ += impulse.force.cwiseProduct(free_axes_) / mass_;
  angular_momentum_ += impulse.moment.cwiseProduct(free_turns_);
}

double FreeBody::impulse_energy(const Wrench& impulse) const {
  const Eigen::Vector3d force = impulse.force.cwiseProduct(free_axes_);
  return 0.5 * (force.squaredNorm() / mass_ + impulse.moment.dot(response(impulse).angular_velocity));
}

void FreeBody::note_joint_impulse(double dt) {
  const Response changed = response(joint_impulse_);
  by_joints_ = changed.velocity / dt;
  turned_by_joints_ = changed.angular_velocity / dt;
}

FreeBody::Response FreeBody::response(const Wrench& impulse) const {
  return {impulse.force.cwiseProduct(free_axes_) / mass_,
          turn_of(pose_.orientation, impulse.moment.cwiseProduct(free_turns_))};
}

Pose FreeBody::drifted(double dt, const Eigen::Vector3d& velocity, const Eigen::Vector3d& turn) const {
  return {pose_.position + dt * (velocity_ + velocity),
          (rotation(dt * (drift_angular_velocity(dt) + turn)) * pose_.orientation).normalized()};
}

Eigen::Vector3d FreeBody::angular_momentum(const Eigen::Quaterniond& q,
                                           const Eigen::Vector3d& angular_velocity) const {
  return q * (inertia_ * (q.conjugate() * angular_velocity));
}

// With P the projection on the free axes:  P I P w = P L. The torques of the locks are about the others.
Eigen::Vector3d FreeBody::turn_of(const Eigen::Quaterniond& q,
                                  const Eigen::Vector3d& angular_momentum) const {
  if (free_turns_ == Eigen::Vector3d::Ones())
    return q * (inverse_inertia_ * (q.conjugate() * angular_momentum));
  const Eigen::Matrix3d R = q.toRotationMatrix(), I = R * inertia_ * R.transpose();
  Eigen::Matrix3d free = free_turns_.asDiagonal() * I * free_turns_.asDiagonal();
  free += Eigen::Matrix3d((Eigen::Vector3d::Ones() - free_turns_).asDiagonal());
  return (free.inverse() * angular_momentum.cwiseProduct(free_turns_)).cwiseProduct(free_turns_);
}

// I dw/dt = T - w x I w
Eigen::Vector3d FreeBody::angular_acceleration() const {
  const Eigen::Quaterniond& q = pose_.orientation;
  const Eigen::Vector3d omega = angular_velocity(q);
  return turn_of(q, wrench_.moment + load_.moment - omega.cross(angular_momentum(q, omega)));
}

Eigen::Vector3d FreeBody::drift_angular_velocity(double dt) const {
  constexpr int kIterations = 20;
  Eigen::Vector3d omega = angular_velocity(pose_.orientation);
  for (int i = 0; i < kIterations; ++i) {
    const Eigen::Vector3d next = angular_velocity(rotation(dt / 2 * omega) * pose_.orientation);
    const double change = (next - omega).norm();
    omega = next;
    if (change <= 1e-15 * omega.norm()) break;
  }
  return omega;
}

Kinematics FreeBody::finish_drift(double dt, const Drift& before, const Drift& after) {
  const Eigen::Quaterniond& q = before.pose.orientation;
  const Eigen::Vector3d turned = after.angular_velocity - before.angular_velocity;
  const Eigen::Vector3d impulse = angular_momentum(q, turned);
  const Eigen::Vector3d contact = (after.velocity - before.velocity) / dt, angular_contact = turned / dt;

  Kinematics step;
  step.acceleration = acceleration() + by_joints_ + lasting(contact_, contact);
  step.angular_acceleration =
      angular_acceleration() + turned_by_joints_ + lasting(angular_contact_, angular_contact);
  contact_ = contact;
  angular_contact_ = angular_contact;

  const Eigen::Vector3d expected = before.pose.position + dt * after.velocity;
  const Eigen::Vector3d push = after.pose.position - expected;
  step.velocity = after.velocity + above_round_off(push, expected.norm()) / dt;
  const Eigen::Quaterniond turn =
      after.pose.orientation * (rotation(dt * after.angular_velocity) * q).conjugate();
  step.angular_velocity = after.angular_velocity + above_round_off(rotation_vector(turn), 0) / dt;

  account_constraint({mass_ * (after.velocity - before.velocity), impulse},
                     0.5 * mass_ * (after.velocity.squaredNorm() - before.velocity.squaredNorm()) +
                         0.5 * impulse.dot(after.angular_velocity + before.angular_velocity));

  pose_ = after.pose;
  // q and -q are one orientation; the sign is kept so that recorded components do not jump.
  if (pose_.orientation.dot(q) < 0) pose_.orientation.coeffs() = -pose_.orientation.coeffs();
  velocity_ = after.velocity;
  angular_momentum_ += impulse.cwiseProduct(free_turns_);
  step.position = pose_.position;
  step.orientation = pose_.orientation;
  return step;
}

Kinematics FreeBody::state() const {
  return {pose_.position, pose_.orientation,     velocity_, angular_velocity(pose_.orientation),
          acceleration(), angular_acceleration()};
}

Account FreeBody::account() const {
  return {
      {mass_ * velocity_, angular_momentum_}, constraint_impulse_, constraint_work_, kinetic_energy(), mass_};
}

double FreeBody::kinetic_energy() const {
  return mass_ / 2 * velocity_.squaredNorm() + angular_velocity(pose_.orientation).dot(angular_momentum_) / 2;
}

}  // namespace sluice::rigid
