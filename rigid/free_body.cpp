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

std::array<bool, 3> inverted(const std::array<bool, 3>& axes) {
  return {!axes[0], !axes[1], !axes[2]};
}

// Of force and moment with velocity and angular velocity.
double dot(const Wrench& wrench, const Wrench& twist) {
  return wrench.force.dot(twist.force) + wrench.moment.dot(twist.moment);
}

void add(Wrench& sum, const Wrench& more) {
  sum.force += more.force;
  sum.moment += more.moment;
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
    : mass_(spec.mass),
      gravity_(gravity),
      dimension_(dimension),
      is_guided_(rigid::is_guided(spec)),
      pose_(spec.pose),
      velocity_(spec.velocity) {
  if (is_guided_)
    set_held(inverted(spec.free), inverted(spec.free_rotation));
  else
    set_held(spec.locked, spec.locked_rotation);
  inertia_ = spec.inertia ? *spec.inertia : homogeneous_inertia(spec, dimension);
  if (dimension == 3) inverse_inertia_ = inertia_.inverse();
  velocity_ = velocity_.cwiseProduct(free_axes_);
  angular_momentum_ = angular_momentum(pose_.orientation, spec.angular_velocity.cwiseProduct(free_turns_))
                          .cwiseProduct(free_turns_);
  if (!is_guided_) return;
  const Offset at_start = spec.motion->at(0);
  guide(at_start.velocity, at_start.angular_velocity);
  driven_ = {};
}

void FreeBody::set_held(const std::array<bool, 3>& axes, const std::array<bool, 3>& turns) {
  const double space = dimension_ == 3 ? 1 : 0;
  const Eigen::Vector3d all_axes(1, 1, space), all_turns(space, space, 1);
  for (int a = 0; a < 3; ++a) {
    free_axes_[a] = axes[static_cast<std::size_t>(a)] ? 0 : all_axes[a];
    free_turns_[a] = turns[static_cast<std::size_t>(a)] ? 0 : all_turns[a];
  }
  is_held_ = free_axes_ != all_axes || free_turns_ != all_turns;
}

Wrench FreeBody::on_free_axes(const Wrench& wrench) const {
  return {wrench.force.cwiseProduct(free_axes_), wrench.moment.cwiseProduct(free_turns_)};
}

Wrench FreeBody::on_held_axes(const Wrench& wrench) const {
  return {wrench.force.cwiseProduct(Eigen::Vector3d::Ones() - free_axes_),
          wrench.moment.cwiseProduct(Eigen::Vector3d::Ones() - free_turns_)};
}

void FreeBody::guide(const Eigen::Vector3d& velocity, const Eigen::Vector3d& turn) {
  const double before = kinetic_energy();
  const Wrench held = on_held_axes({velocity, turn});
  velocity_ = velocity_.cwiseProduct(free_axes_) + held.force;
  guide_turn_ = held.moment;
  driven_.work += kinetic_energy() - before;
  add(driven_.impulse, held_change());
}

void FreeBody::set_off(const Offset& start, const Offset& end, double dt) {
  guide_mean_ = on_held_axes({(end.position - start.position) / dt, (end.rotation - start.rotation) / dt});
  const Wrench accelerations = on_held_axes({end.acceleration, end.angular_acceleration});
  guide_acceleration_ = accelerations.force;
  guide_angular_acceleration_ = accelerations.moment;
  guide(guide_mean_.force, guide_mean_.moment);
}

void FreeBody::arrive(const BodySpec& spec, const Offset& end) {
  const Eigen::Vector3d way = spec.pose.position + end.position - pose_.position;
  pose_.position += way.cwiseProduct(Eigen::Vector3d::Ones() - free_axes_);
  guide(end.velocity, end.angular_velocity);
}

// The drive gives its part of the momentum away, but for that along axes that are locked from now on.
void FreeBody::let_go(const BodySpec& spec) {
  const double energy = kinetic_energy();
  const Wrench before = momentum();
  is_guided_ = false;
  set_held(spec.locked, spec.locked_rotation);
  velocity_ = velocity_.cwiseProduct(free_axes_);
  angular_momentum_ = before.moment.cwiseProduct(free_turns_);
  guide_turn_ = guide_acceleration_ = guide_angular_acceleration_ = Eigen::Vector3d::Zero();
  guide_mean_ = {};
  driven_.work += kinetic_energy() - energy;
  const Wrench now = momentum();
  add(driven_.impulse, {now.force - before.force, now.moment - before.moment});
  held_ = on_held_axes(now);
}

Wrench FreeBody::held_change() {
  if (!is_held_) return {};
  const Wrench before = held_;
  held_ = on_held_axes(momentum());
  return {held_.force - before.force, held_.moment - before.moment};
}

void FreeBody::account_held(const Wrench& taken) {
  if (!is_held_) return;
  const Wrench change = held_change();
  const Wrench given{change.force - taken.force, change.moment - taken.moment};
  add(driven_.impulse, given);
  driven_.work += dot(given, guide_mean_);
}

void FreeBody::set_wrench(const Wrench& wrench) {
  wrench_ = on_free_axes(wrench);
  blocked_ = on_held_axes(wrench);
}

void FreeBody::set_load(const Wrench& load) {
  load_ = on_free_axes(load);
}

void FreeBody::kick(double dt) {
  velocity_ += dt * free_acceleration();
  angular_momentum_ += dt * (wrench_.moment + load_.moment);
  account_joint({dt * load_.force, dt * load_.moment});
  const Wrench weight = on_held_axes({mass_ * gravity_, Eigen::Vector3d::Zero()});
  account_held({dt * (blocked_.force + weight.force), dt * blocked_.moment});
}

void FreeBody::begin_step() {
  joint_impulse_ = before_drift_ = hits_ = {};
  start_velocity_ = {velocity_, angular_velocity(pose_.orientation)};
  is_before_drift_ = true;
}

void FreeBody::apply_joint(const Wrench& impulse, bool is_hit) {
  push_free(impulse);
  account_held({});
  add(joint_impulse_, impulse);
  account_joint(on_free_axes(impulse));
  if (is_hit) add(hits_, on_free_axes(impulse));
}

void FreeBody::account_joint(const Wrench& impulse) {
  add(joined_.impulse, impulse);
  if (is_before_drift_)
    add(before_drift_, impulse);
  else
    joined_.work += dot(impulse, drift_velocity_);
}

void FreeBody::push(const Wrench& impulse) {
  push_free(impulse);
  account_held(on_held_axes(impulse));
}

void FreeBody::push_free(const Wrench& impulse) {
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

// With w0 about the axes that are guided:  P I w = P L,  w = w0 + (P I P)^-1 P (L - I w0).
Eigen::Vector3d FreeBody::angular_velocity(const Eigen::Quaterniond& q) const {
  if (guide_turn_.isZero(0)) return turn_of(q, angular_momentum_);
  return guide_turn_ + turn_of(q, angular_momentum_ - angular_momentum(q, guide_turn_));
}

Wrench FreeBody::momentum() const {
  const Eigen::Quaterniond& q = pose_.orientation;
  if (!is_held_) return {mass_ * velocity_, angular_momentum_};
  const Eigen::Vector3d whole = angular_momentum(q, angular_velocity(q));
  return {mass_ * velocity_, angular_momentum_ + whole.cwiseProduct(Eigen::Vector3d::Ones() - free_turns_)};
}

// I dw/dt = T - w x I w
Eigen::Vector3d FreeBody::angular_acceleration() const {
  const Eigen::Quaterniond& q = pose_.orientation;
  const Eigen::Vector3d omega = angular_velocity(q), &guided = guide_angular_acceleration_;
  return guided + turn_of(q, wrench_.moment + load_.moment - omega.cross(angular_momentum(q, omega)) -
                                 angular_momentum(q, guided));
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

  is_before_drift_ = false;
  drift_velocity_ = {after.velocity, after.angular_velocity};
  joined_.work += dot(before_drift_, drift_velocity_);
  // What hits a stop or another body works on the mean of the velocities before and after.
  joined_.work += 0.5 * (dot(hits_, start_velocity_) - dot(hits_, drift_velocity_));
  const Wrench by_contact = on_free_axes({mass_ * (after.velocity - before.velocity), impulse});
  add(by_contact_.impulse, by_contact);
  by_contact_.work += 0.5 * (dot(by_contact, start_velocity_) + dot(by_contact, drift_velocity_));

  pose_ = after.pose;
  // q and -q are one orientation; the sign is kept so that recorded components do not jump.
  if (pose_.orientation.dot(q) < 0) pose_.orientation.coeffs() = -pose_.orientation.coeffs();
  velocity_ = after.velocity;
  angular_momentum_ += impulse.cwiseProduct(free_turns_);
  account_held({});
  step.position = pose_.position;
  step.orientation = pose_.orientation;
  return step;
}

Kinematics FreeBody::state() const {
  return {pose_.position, pose_.orientation,     velocity_, angular_velocity(pose_.orientation),
          acceleration(), angular_acceleration()};
}

Account FreeBody::account() const {
  return {momentum(), by_contact_, joined_, driven_, kinetic_energy(), mass_};
}

double FreeBody::kinetic_energy() const {
  const Eigen::Vector3d omega = angular_velocity(pose_.orientation);
  return mass_ / 2 * velocity_.squaredNorm() + omega.dot(momentum().moment) / 2;
}

}  // namespace sluice::rigid
