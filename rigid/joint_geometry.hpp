#pragma once

#include <vector>

#include "rigid/joint.hpp"
#include "rigid/kinematics.hpp"
#include "rigid/shape.hpp"

namespace sluice::rigid {

// How a scalar of two poses changes: by force.V + moment.w of each body. An impulse of size 1 through it
// gives the bodies these impulses.
struct Row {
  Wrench on_a, on_b;
};

// A joint in the frames of its bodies.
class JointGeometry {
 public:
  JointGeometry(const JointSpec& spec, const Pose& a, const Pose& b);

  // What must stay zero, in the same order as rows(): ways [m] and angles [rad].
  [[nodiscard]] std::vector<double> residuals(const Pose& a, const Pose& b) const;
  [[nodiscard]] std::vector<Row> rows(const Pose& a, const Pose& b) const;

  // Angle of a hinge in -pi .. pi, way of a slider, length of a spring; and how it changes.
  [[nodiscard]] double coordinate(const Pose& a, const Pose& b) const;
  [[nodiscard]] Row coordinate_row(const Pose& a, const Pose& b) const;

 private:
  using Kind = JointSpec::Kind;

  Kind kind_;
  Eigen::Vector3d on_a_, on_b_;        // the points of the joint, in the bodies' frames
  Eigen::Vector3d axis_a_, axis_;      // in the frames of a and of b
  Eigen::Vector3d across1_, across2_;  // complete the axis, frame of b
  Eigen::Quaterniond turned_;          // a against b at time 0
};

}  // namespace sluice::rigid
