#pragma once

#include <functional>

#include "rigid/joint_solver.hpp"

namespace sluice::rigid {

// One scalar of a step that joints prescribe: its value at the end of the drift is to be zero.
struct Constraint {
  std::size_t a, b;
  Row row;  // at the start of the drift
  std::function<double(const Pose& a, const Pose& b)> residual;
  double least = -std::numeric_limits<double>::infinity(), most = std::numeric_limits<double>::infinity();
  enum class Kind { hold, motor, lower, upper } kind = Kind::hold;
  bool active = true;
  double impulse = 0;  // so far

  void apply(double more, std::span<JointedBody> bodies);
};

using PoseOf = Pose (*)(std::span<const JointedBody> bodies, std::size_t body);
Pose start_of(std::span<const JointedBody> bodies, std::size_t body);
Pose end_of(std::span<const JointedBody> bodies, std::size_t body);  // of free bodies, where they are now
std::vector<Pose> end_poses(std::span<const JointedBody> bodies, double dt);

// What a joint holds; all it does over a drift of dt, motors and limits too.
void append_holds(const JointSpec& spec, const JointGeometry& geometry, PoseOf pose_of,
                  std::span<const JointedBody> bodies, std::vector<Constraint>& constraints);
void append_constraints(const JointSpec& spec, const JointGeometry& geometry, double dt,
                        std::span<const JointedBody> bodies, std::vector<Constraint>& constraints);

std::vector<Constraint*> active_of(std::vector<Constraint>& constraints);
Eigen::VectorXd residuals(std::span<Constraint* const> active, std::span<const Pose> ends);

// [c, d]: what a unit impulse through d changes of the rate of c.
Eigen::MatrixXd response(std::span<Constraint* const> active, std::span<const JointedBody> bodies);

// row.V of the velocities of this instant.
double rate_of(const Row& row, std::size_t a, std::size_t b, std::span<const JointedBody> bodies);

// Motors that need more than their strength give that and no more; limits act where they are passed, and let
// go where they would pull. Whether anything changed.
bool change_active_set(std::vector<Constraint>& constraints, std::span<const Pose> ends,
                       std::span<JointedBody> bodies);

}  // namespace sluice::rigid
