#include "rigid/joint_solver.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include <Eigen/QR>
#include <cmath>
#include <stdexcept>

#include "rigid/joint_constraints.hpp"

namespace sluice::rigid {
namespace {

constexpr int kNewtonSteps = 50, kActiveSets = 20;
constexpr double kHeld = 1e-13;   // what is left of a way [m] or angle [rad]
constexpr double kBroken = 1e-6;  // left after all iterations: the joint is lost
constexpr double kRank = 1e-9;    // of scaled rows: dependent below

// K x = r for a symmetric K that may lack rank, as in closed chains; the smallest such x.
Eigen::VectorXd solve(const Eigen::MatrixXd& K, const Eigen::VectorXd& r) {
  const Eigen::VectorXd scale =
      K.diagonal().unaryExpr([](double k) { return k > 0 ? 1 / std::sqrt(k) : 0.0; });
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> solver;
  solver.setThreshold(kRank);
  solver.compute(scale.asDiagonal() * K * scale.asDiagonal());
  return scale.asDiagonal() * Eigen::VectorXd(solver.solve(scale.asDiagonal() * r));
}

}  // namespace

JointSolver::JointSolver(std::span<const JointSpec> joints, std::span<const BodySpec> bodies) {
  for (const JointSpec& joint : joints) {
    const Pose a = bodies[joint.a].pose, b = joint.b == kWorld ? Pose{} : bodies[joint.b].pose;
    JointGeometry geometry(joint, a, b);
    const double start = joint.kind == JointSpec::Kind::spring ? geometry.coordinate(a, b) : 0;
    names_.push_back(fmt::format("'{}'", bodies[joint.a].name));
    joints_.push_back({joint, geometry, joint.rest.value_or(start)});
  }
}

bool JointSolver::has_dampers() const {
  return std::any_of(joints_.begin(), joints_.end(), [](const Joint& j) { return j.spec.damping > 0; });
}

bool JointSolver::holds(std::size_t body) const {
  return std::any_of(joints_.begin(), joints_.end(), [&](const Joint& j) {
    return j.spec.kind != JointSpec::Kind::spring && (j.spec.a == body || j.spec.b == body);
  });
}

void JointSolver::hold(double dt, std::span<JointedBody> bodies) const {
  std::vector<Constraint> constraints;
  for (const Joint& joint : joints_) append_constraints(joint.spec, joint.geometry, dt, bodies, constraints);
  for (int set = 0; set < kActiveSets; ++set) {
    double left = 0;
    for (int i = 0; i < kNewtonSteps; ++i) {
      const std::vector<Constraint*> active = active_of(constraints);
      if (active.empty()) break;
      const std::vector<Pose> ends = end_poses(bodies, dt);
      const Eigen::VectorXd r = residuals(active, ends);
      const double before = left;
      left = r.cwiseAbs().maxCoeff();
      if (left < kHeld || (i > 2 && left > before / 2 && left < kBroken)) break;
      const Eigen::VectorXd impulse = solve(dt * response(active, bodies), -r);
      for (std::size_t c = 0; c < active.size(); ++c)
        active[c]->apply(impulse[static_cast<Eigen::Index>(c)], bodies);
    }
    if (!(left < kBroken)) {
      throw std::runtime_error(
          fmt::format("the joints of body {} cannot be held within a step of {:g} s: {:g} m or rad are left; "
                      "check that they "
                      "do not contradict each other and that the forces are sound",
                      fmt::join(names_, ", "), dt, left));
    }
    if (!change_active_set(constraints, end_poses(bodies, dt), bodies)) break;
  }
  for (JointedBody& body : bodies)
    if (body.free != nullptr) body.free->note_joint_impulse(dt);
}

void JointSolver::project(std::span<JointedBody> bodies) const {
  std::vector<Constraint> constraints;
  for (const Joint& joint : joints_) append_holds(joint.spec, joint.geometry, end_of, bodies, constraints);
  if (constraints.empty()) return;
  const std::vector<Constraint*> active = active_of(constraints);
  Eigen::VectorXd rate(static_cast<Eigen::Index>(active.size()));
  for (std::size_t c = 0; c < active.size(); ++c)
    rate[static_cast<Eigen::Index>(c)] = rate_of(active[c]->row, active[c]->a, active[c]->b, bodies);
  const Eigen::VectorXd impulse = solve(response(active, bodies), -rate);
  for (std::size_t c = 0; c < active.size(); ++c)
    active[c]->apply(impulse[static_cast<Eigen::Index>(c)], bodies);
}

std::vector<Wrench> JointSolver::loads(std::span<const JointedBody> bodies) const {
  std::vector<Wrench> sum(bodies.size());
  for (const Joint& joint : joints_) {
    const JointSpec& spec = joint.spec;
    if (spec.stiffness == 0 && spec.damping == 0) continue;
    const Pose a = end_of(bodies, spec.a), b = end_of(bodies, spec.b);
    const Row row = joint.geometry.coordinate_row(a, b);
    const double force = -spec.stiffness * (joint.geometry.coordinate(a, b) - joint.rest) -
                         spec.damping * rate_of(row, spec.a, spec.b, bodies);
    const auto add = [&](std::size_t body, const Wrench& w) {
      if (body == kWorld) return;
      sum[body].force += force * w.force;
      sum[body].moment += force * w.moment;
    };
    add(spec.a, row.on_a);
    add(spec.b, row.on_b);
  }
  return sum;
}

}  // namespace sluice::rigid
