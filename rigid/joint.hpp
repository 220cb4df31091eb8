#pragma once

#include <Eigen/Core>
#include <limits>
#include <optional>

namespace sluice::rigid {

constexpr std::size_t kWorld = std::numeric_limits<std::size_t>::max();

// What holds body `a` to body `b`, or to the world (kWorld). Places and directions are those of time 0, in
// the world's frame. Its coordinate is the angle [rad] of a hinge, the way [m] of a slider, of a against b
// from time 0 on.
struct JointSpec {
  enum class Kind { fixed, hinge, slider, spring };

  Kind kind = Kind::fixed;
  std::size_t a = 0, b = kWorld;
  Eigen::Vector3d point = Eigen::Vector3d::Zero();      // of a hinge; where a spring is fixed to a [m]
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();      // of a hinge or slider, unit length
  Eigen::Vector3d other_end = Eigen::Vector3d::Zero();  // where a spring is fixed to b [m]

  // Of hinge and slider: what the coordinate may be.
  double lower = -std::numeric_limits<double>::infinity(), upper = std::numeric_limits<double>::infinity();
  // Of hinge and slider: drives the coordinate at `speed` [rad/s], [m/s] as long as that takes no more than
  // `strength` [N m], [N].
  struct Motor {
    double speed = 0, strength = 0;
  };
  std::optional<Motor> motor;

  // Force or moment -stiffness * (coordinate - rest) - damping * its rate; of a spring the coordinate is its
  // length, and its rest that of time 0 unless given. [N/m], [N s/m], of a hinge [N m/rad], [N m s/rad].
  double stiffness = 0, damping = 0;
  std::optional<double> rest;
};

}  // namespace sluice::rigid
