#include "rigid/joint_geometry.hpp"

#include <cmath>

namespace sluice::rigid {
namespace {

Eigen::Vector3d world(const Pose& pose, const Eigen::Vector3d& local) {
  return pose.position + pose.orientation * local;
}

// n . (x_a - x_b), x_a fixed to a and n to b, changes by n.(V_a - V_b) + (r_a x n).w_a - (r_b x n).w_b with
// the arms of x_a from both centres.
Row along(const Eigen::Vector3d& n, const Eigen::Vector3d& x_a, const Pose& a, const Pose& b) {
  return {{n, (x_a - a.position).cross(n)}, {-n, -(x_a - b.position).cross(n)}};
}

Row about(const Eigen::Vector3d& e) {
  return {{Eigen::Vector3d::Zero(), e}, {Eigen::Vector3d::Zero(), -e}};
}

}  // namespace

JointGeometry::JointGeometry(const JointSpec& spec, const Pose& a, const Pose& b) : kind_(spec.kind) {
  const Eigen::Quaterniond to_a = a.orientation.conjugate(), to_b = b.orientation.conjugate();
  on_a_ = to_a * (spec.point - a.position);
  on_b_ = to_b * ((kind_ == Kind::spring ? spec.other_end : spec.point) - b.position);
  axis_a_ = to_a * spec.axis;
  axis_ = to_b * spec.axis;
  across1_ = axis_.unitOrthogonal();
  across2_ = axis_.cross(across1_);
  turned_ = to_b * a.orientation;
}

std::vector<double> JointGeometry::residuals(const Pose& a, const Pose& b) const {
  std::vector<double> values;
  if (kind_ == Kind::spring) return values;
  const Eigen::Vector3d way = world(a, on_a_) - world(b, on_b_);
  const Eigen::Quaterniond& q = b.orientation;
  for (const Eigen::Vector3d& n : {across1_, across2_}) values.push_back(way.dot(q * n));
  if (kind_ != Kind::slider) values.push_back(way.dot(q * axis_));
  if (kind_ == Kind::hinge) {
    for (const Eigen::Vector3d& n : {across1_, across2_})
      values.push_back((a.orientation * axis_a_).dot(q * n));
    return values;
  }
  // The rotation that a has made against b: twice its vector part, in b's frame.
  const Eigen::Quaterniond turn = q.conjugate() * a.orientation * turned_.conjugate();
  const Eigen::Vector3d vector = 2 * std::copysign(1.0, turn.w()) * turn.vec();
  for (const Eigen::Vector3d& n : {across1_, across2_, axis_}) values.push_back(vector.dot(n));
  return values;
}

std::vector<Row> JointGeometry::rows(const Pose& a, const Pose& b) const {
  std::vector<Row> rows;
  if (kind_ == Kind::spring) return rows;
  const Eigen::Vector3d x_a = world(a, on_a_);
  const Eigen::Quaterniond& q = b.orientation;
  for (const Eigen::Vector3d& n : {across1_, across2_}) rows.push_back(along(q * n, x_a, a, b));
  if (kind_ != Kind::slider) rows.push_back(along(q * axis_, x_a, a, b));
  if (kind_ == Kind::hinge) {
    // d/dt (axis_a . n_b) = (axis_a x n_b) . (w_a - w_b)
    for (const Eigen::Vector3d& n : {across1_, across2_})
      rows.push_back(about((a.orientation * axis_a_).cross(q * n)));
    return rows;
  }
  for (const Eigen::Vector3d& n : {across1_, across2_, axis_}) rows.push_back(about(q * n));
  return rows;
}

double JointGeometry::coordinate(const Pose& a, const Pose& b) const {
  const Eigen::Vector3d way = world(a, on_a_) - world(b, on_b_);
  if (kind_ == Kind::spring) return way.norm();
  if (kind_ == Kind::slider) return way.dot(b.orientation * axis_);
  const Eigen::Quaterniond turn = b.orientation.conjugate() * a.orientation * turned_.conjugate();
  return 2 * std::atan2(std::copysign(1.0, turn.w()) * turn.vec().dot(axis_), std::abs(turn.w()));
}

Row JointGeometry::coordinate_row(const Pose& a, const Pose& b) const {
  const Eigen::Vector3d x_a = world(a, on_a_), x_b = world(b, on_b_);
  if (kind_ == Kind::slider) return along(b.orientation * axis_, x_a, a, b);
  if (kind_ == Kind::hinge) return about(b.orientation * axis_);
  const Eigen::Vector3d way = x_a - x_b;
  const Eigen::Vector3d n = way.norm() > 0 ? Eigen::Vector3d(way.normalized()) : Eigen::Vector3d::UnitX();
  return {{n, (x_a - a.position).cross(n)}, {-n, -(x_b - b.position).cross(n)}};
}

}  // namespace sluice::rigid
