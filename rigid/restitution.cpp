#include "rigid/restitution.hpp"

#include <algorithm>
#include <cmath>

namespace sluice::rigid {
namespace {

constexpr int kIterations = 100;
constexpr double kRestSteps = 4;  // of |a_n| dt: slower than this bodies rest on each other

using Bodies = std::span<FreeBody::Drift>;
using ConstBodies = std::span<const FreeBody::Drift>;

Eigen::Vector3d velocity_at(ConstBodies bodies, std::size_t b, const Eigen::Vector3d& arm) {
  if (b == kWall) return Eigen::Vector3d::Zero();
  return bodies[b].velocity + bodies[b].angular_velocity.cross(arm);
}

Eigen::Vector3d relative_velocity(ConstBodies bodies, const Touch& touch) {
  return velocity_at(bodies, touch.a, touch.arm_a) - velocity_at(bodies, touch.b, touch.arm_b);
}

// One touch while impulses are exchanged through it.
class Exchange {
 public:
  Exchange(const Touch& touch, std::span<const Inertia> inertia, ConstBodies inelastic)
      : touch_(touch), inertia_(inertia), normal_mass_(1 / response(touch.normal)) {
    const double now = relative_velocity(inelastic, touch).dot(touch.normal);
    target_ = touch.is_impact ? std::max(touch.rebound, now) : now;
  }

  // The change of the normal impulse.
  double solve(Bodies bodies) {
    const double missing = target_ - relative_velocity(bodies, touch_).dot(touch_.normal);
    const double before = impulse_;
    impulse_ = std::max(0.0, impulse_ + normal_mass_ * missing);
    apply((impulse_ - before) * touch_.normal, bodies);
    return std::abs(impulse_ - before);
  }

  void rub(Bodies bodies) const {
    const Eigen::Vector3d v = relative_velocity(bodies, touch_),
                          slip = v - v.dot(touch_.normal) * touch_.normal;
    const double speed = slip.norm();
    if (speed == 0 || impulse_ == 0) return;
    const Eigen::Vector3d direction = slip / speed;
    apply(-std::min(touch_.friction * impulse_, speed / response(direction)) * direction, bodies);
  }

 private:
  // Change of the relative velocity along n by a unit impulse along n.
  [[nodiscard]] double response(const Eigen::Vector3d& n) const {
    double sum = 0;
    for (const auto& [b, arm] : {std::pair{touch_.a, touch_.arm_a}, std::pair{touch_.b, touch_.arm_b}}) {
      if (b == kWall) continue;
      const Eigen::Vector3d turn = arm.cross(n);
      sum += n.dot(inertia_[b].inverse_mass.cwiseProduct(n)) + turn.dot(inertia_[b].inverse_inertia * turn);
    }
    return sum;
  }

  void apply(const Eigen::Vector3d& impulse, Bodies bodies) const {
    push(touch_.a, touch_.arm_a, impulse, bodies);
    push(touch_.b, touch_.arm_b, -impulse, bodies);
  }
  void push(std::size_t b, const Eigen::Vector3d& arm, const Eigen::Vector3d& impulse, Bodies bodies) const {
    if (b == kWall) return;
    bodies[b].velocity += inertia_[b].inverse_mass.cwiseProduct(impulse);
    bodies[b].angular_velocity += inertia_[b].inverse_inertia * arm.cross(impulse);
  }

  const Touch& touch_;
  std::span<const Inertia> inertia_;
  double normal_mass_, target_ = 0, impulse_ = 0;
};

// A body goes on as before contact until it meets, and with the velocities after the rebound from then on.
void move_on(double dt, std::span<const Touch> touches, ConstBodies before, Bodies bodies) {
  std::vector<double> when(bodies.size(), 2);
  for (const Touch& touch : touches)
    for (const std::size_t b : {touch.a, touch.b})
      if (touch.is_impact && b != kWall) when[b] = std::min(when[b], touch.when);
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    if (when[b] > 1) continue;
    const auto way = [&](const Eigen::Vector3d& until, const Eigen::Vector3d& from) {
      return Eigen::Vector3d(dt * (when[b] * until + (1 - when[b]) * from));
    };
    const Pose& start = before[b].pose;
    bodies[b].pose.position = start.position + way(before[b].velocity, bodies[b].velocity);
    bodies[b].pose.orientation =
        rotation(way(before[b].angular_velocity, bodies[b].angular_velocity)) * start.orientation;
  }
}

}  // namespace

bool is_closed(const Touch& touch, ConstBodies before, ConstBodies after, double dt) {
  constexpr double kShare = 1e-3, kLeast = 1e-9;  // of the approach, [m/s]: what the solver leaves open
  const double approach = std::abs(relative_velocity(before, touch).dot(touch.normal));
  return relative_velocity(after, touch).dot(touch.normal) + std::max(0.0, touch.gap) / dt <=
         kShare * approach + kLeast;
}

void find_impact(Touch& touch, ConstBodies before, double dt) {
  const auto acceleration = [&](std::size_t b) {
    return b == kWall ? 0.0 : before[b].acceleration.dot(touch.normal);
  };
  const double v = relative_velocity(before, touch).dot(touch.normal),
               a = acceleration(touch.a) - acceleration(touch.b);
  touch.is_impact = touch.restitution > 0 && -v > kRestSteps * dt * std::abs(a);
  if (!touch.is_impact) return;
  touch.when = std::clamp(touch.gap / (-v * dt), -1.0, 1.0);
  const double met = v + a * (touch.when - 0.5) * dt;
  touch.rebound = -touch.restitution * met + a * (0.5 - touch.when) * dt;
}

void throw_back(double dt, std::span<const Touch> touches, std::span<const Inertia> inertia,
                ConstBodies before, Bodies bodies) {
  const std::vector<FreeBody::Drift> inelastic(bodies.begin(), bodies.end());
  std::vector<Exchange> exchanges;
  for (const Touch& touch : touches) exchanges.emplace_back(touch, inertia, inelastic);
  for (int i = 0; i < kIterations; ++i) {
    double changed = 0;
    for (Exchange& exchange : exchanges) changed += exchange.solve(bodies);
    if (changed == 0) break;
  }
  for (const Exchange& exchange : exchanges) exchange.rub(bodies);
  move_on(dt, touches, before, bodies);
}

}  // namespace sluice::rigid
