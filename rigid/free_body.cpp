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
  const bool planar = dimension == 2;
  free_axes_ = planar ? Eigen::Vector3d(1, 1, 0) : Eigen::Vector3d::Ones();
  free_turns_ = planar ? Eigen::Vector3d(0, 0, 1) : Eigen::Vector3d::Ones();
  const Solid homogeneous = solid(spec.shape, dimension);
  inertia_ = mass_ / homogeneous.volume * homogeneous.inertia;
  inverse_inertia_ =
      planar ? Eigen::Vector3d(0, 0, 1 / inertia_.z()) : Eigen::Vector3d(inertia_.cwiseInverse());
  gravity_ = gravity_.cwiseProduct(free_axes_);
  velocity_ = velocity_.cwiseProduct(free_axes_);
  const Eigen::Quaterniond& q = pose_.orientation;
  angular_momentum_ =
      q * inertia_.cwiseProduct(q.conjugate() * spec.angular_velocity.cwiseProduct(free_turns_));
}

void FreeBody::set_wrench(const Wrench& wrench) {
  wrench_.force = wrench.force.cwiseProduct(free_axes_);
  wrench_.moment = wrench.moment.cwiseProduct(free_turns_);
}

void FreeBody::kick(double dt) {
  velocity_ += dt * acceleration();
  angular_momentum_ += dt * wrench_.moment;
}

void FreeBody::push(const Wrench& impulse) {
  velocity_ += impulse.force.cwiseProduct(free_axes_) / mass_;
  angular_momentum_ += impulse.moment.cwiseProduct(free_turns_);
}

double FreeBody::impulse_energy(const Wrench& impulse) const {
  const Eigen::Vector3d moment = pose_.orientation.conjugate() * impulse.moment.cwiseProduct(free_turns_);
  return 0.5 * (impulse.force.cwiseProduct(free_axes_).squaredNorm() / mass_ +
                moment.dot(inverse_inertia_.cwiseProduct(moment)));
}

Eigen::Vector3d FreeBody::angular_velocity(const Eigen::Quaterniond& q) const {
  return q * inverse_inertia_.cwiseProduct(q.conjugate() * angular_momentum_);
}

Eigen::Vector3d FreeBody::angular_acceleration() const {
  const Eigen::Quaterniond& q = pose_.orientation;
  const Eigen::Vector3d torque = wrench_.moment - angular_velocity(q).cross(angular_momentum_);
  return q * inverse_inertia_.cwiseProduct(q.conjugate() * torque);
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
  const Eigen::Vector3d impulse = q * inertia_.cwiseProduct(q.conjugate() * turned);
  const Eigen::Vector3d contact = (after.velocity - before.velocity) / dt, angular_contact = turned / dt;

  Kinematics step;
  step.acceleration = acceleration() + lasting(contact_, contact);
  step.angular_acceleration = angular_acceleration() + lasting(angular_contact_, angular_contact);
  contact_ = contact;
  angular_contact_ = angular_contact;

  const Eigen::Vector3d expected = before.pose.position + dt * after.velocity;
  const Eigen::Vector3d push = after.pose.position - expected;
  step.velocity = after.velocity + above_round_off(push, expected.norm()) / dt;
  const Eigen::Quaterniond turn =
      after.pose.orientation * (rotation(dt * after.angular_velocity) * q).conjugate();
  step.angular_velocity = after.angular_velocity + above_round_off(rotation_vector(turn), 0) / dt;

  constraint_impulse_.force += mass_ * (after.velocity - before.velocity);
  constraint_impulse_.moment += impulse.cwiseProduct(free_turns_);
  constraint_work_ += 0.5 * mass_ * (after.velocity.squaredNorm() - before.velocity.squaredNorm()) +
                      0.5 * impulse.dot(after.angular_velocity + before.angular_velocity);

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
