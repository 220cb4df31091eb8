#include "rigid/joint_constraints.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sluice::rigid {
namespace {

constexpr double kPassed = 1e-12;  // beyond a limit [m], [rad]

Wrench scaled(double factor, const Wrench& wrench) {
  return {factor * wrench.force, factor * wrench.moment};
}

double dot(const Wrench& row, const Eigen::Vector3d& velocity, const Eigen::Vector3d& angular_velocity) {
  return row.force.dot(velocity) + row.moment.dot(angular_velocity);
}

// An angle's way past a turn is the shorter one.
double wrapped(double angle) {
  return std::remainder(angle, 2 * std::numbers::pi);
}

const Pose& pose_at(std::span<const Pose> ends, std::size_t body) {
  static const Pose world;
  return body == kWorld ? world : ends[body];
}

}  // namespace

void Constraint::apply(double more, std::span<JointedBody> bodies) {
  impulse += more;
  for (const auto& [body, wrench] : {std::pair{a, &row.on_a}, std::pair{b, &row.on_b}})
    if (body != kWorld && bodies[body].free != nullptr)
      bodies[body].free->apply_joint(scaled(more, *wrench), kind == Kind::lower || kind == Kind::upper);
}

Pose start_of(std::span<const JointedBody> bodies, std::size_t body) {
  if (body == kWorld) return {};
  return bodies[body].free != nullptr ? bodies[body].free->pose() : bodies[body].start;
}

Pose end_of(std::span<const JointedBody> bodies, std::size_t body) {
  if (body == kWorld) return {};
  return bodies[body].free != nullptr ? bodies[body].free->pose() : bodies[body].end;
}

std::vector<Pose> end_poses(std::span<const JointedBody> bodies, double dt) {
  std::vector<Pose> ends;
  for (const JointedBody& body : bodies)
    ends.push_back(body.free != nullptr ? body.free->drifted(dt, body.contact, body.contact_turn) : body.end);
  return ends;
}

void append_holds(const JointSpec& spec, const JointGeometry& geometry, PoseOf pose_of,
                  std::span<const JointedBody> bodies, std::vector<Constraint>& constraints) {
  const std::vector<Row> rows = geometry.rows(pose_of(bodies, spec.a), pose_of(bodies, spec.b));
  for (std::size_t k = 0; k < rows.size(); ++k)
    constraints.push_back({spec.a, spec.b, rows[k], [&geometry, k](const Pose& a, const Pose& b) {
                             return geometry.residuals(a, b)[k];
                           }});
}

void append_constraints(const JointSpec& spec, const JointGeometry& geometry, double dt,
                        std::span<const JointedBody> bodies, std::vector<Constraint>& constraints) {
  append_holds(spec, geometry, start_of, bodies, constraints);
  const Pose a0 = start_of(bodies, spec.a), b0 = start_of(bodies, spec.b);
  const auto add = [&](Constraint::Kind kind, double target, bool turns) {
    Constraint row{spec.a, spec.b, geometry.coordinate_row(a0, b0),
                   [&geometry, target, turns](const Pose& a, const Pose& b) {
                     const double way = geometry.coordinate(a, b) - target;
                     return turns ? wrapped(way) : way;
                   }};
    row.kind = kind;
    row.active = kind == Constraint::Kind::motor;
    constraints.push_back(std::move(row));
  };
  const bool turns = spec.kind == JointSpec::Kind::hinge;
  if (spec.motor) {
    add(Constraint::Kind::motor, geometry.coordinate(a0, b0) + spec.motor->speed * dt, turns);
    constraints.back().most = spec.motor->strength * dt;
    constraints.back().least = -constraints.back().most;
  }
  if (std::isfinite(spec.lower)) add(Constraint::Kind::lower, spec.lower, false);
  if (std::isfinite(spec.upper)) add(Constraint::Kind::upper, spec.upper, false);
}

std::vector<Constraint*> active_of(std::vector<Constraint>& constraints) {
  std::vector<Constraint*> active;
  for (Constraint& constraint : constraints)
    if (constraint.active) active.push_back(&constraint);
  return active;
}

Eigen::VectorXd residuals(std::span<Constraint* const> active, std::span<const Pose> ends) {
  Eigen::VectorXd values(static_cast<Eigen::Index>(active.size()));
  for (std::size_t c = 0; c < active.size(); ++c)
    values[static_cast<Eigen::Index>(c)] =
        active[c]->residual(pose_at(ends, active[c]->a), pose_at(ends, active[c]->b));
  return values;
}

Eigen::MatrixXd response(std::span<Constraint* const> active, std::span<const JointedBody> bodies) {
  const auto n = static_cast<Eigen::Index>(active.size());
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index d = 0; d < n; ++d) {
    const Constraint& by = *active[static_cast<std::size_t>(d)];
    for (const auto& [body, wrench] : {std::pair{by.a, &by.row.on_a}, std::pair{by.b, &by.row.on_b}}) {
      if (body == kWorld || bodies[body].free == nullptr) continue;
      const FreeBody::Response moved = bodies[body].free->response(*wrench);
      for (Eigen::Index c = 0; c < n; ++c) {
        const Constraint& on = *active[static_cast<std::size_t>(c)];
        if (on.a == body) K(c, d) += dot(on.row.on_a, moved.velocity, moved.angular_velocity);
        if (on.b == body) K(c, d) += dot(on.row.on_b, moved.velocity, moved.angular_velocity);
      }
    }
  }
  return K;
}

double rate_of(const Row& row, std::size_t a, std::size_t b, std::span<const JointedBody> bodies) {
  const auto part = [&](std::size_t body, const Wrench& wrench) {
    if (body == kWorld) return 0.0;
    const JointedBody& of = bodies[body];
    if (of.free == nullptr) return dot(wrench, of.velocity, of.angular_velocity);
    const Kinematics now = of.free->state();
    return dot(wrench, now.velocity, now.angular_velocity);
  };
  return part(a, row.on_a) + part(b, row.on_b);
}

bool change_active_set(std::vector<Constraint>& constraints, std::span<const Pose> ends,
                       std::span<JointedBody> bodies) {
  bool changed = false;
  for (Constraint& c : constraints) {
    using Kind = Constraint::Kind;
    if (c.kind == Kind::hold) continue;
    if (c.kind == Kind::motor) {
      const double allowed = std::clamp(c.impulse, c.least, c.most);
      if (!c.active || allowed == c.impulse) continue;
      c.apply(allowed - c.impulse, bodies);
      c.active = false;
      changed = true;
      continue;
    }
    const double sign = c.kind == Kind::upper ? -1 : 1;  // of the impulses that a limit may give
    const double inside = sign * c.residual(pose_at(ends, c.a), pose_at(ends, c.b));
    if (!c.active && inside < -kPassed) {
      c.active = changed = true;
    } else if (c.active && sign * c.impulse < 0) {
      c.apply(-c.impulse, bodies);
      c.active = false;
      changed = true;
    }
  }
  return changed;
}

}  // namespace sluice::rigid
