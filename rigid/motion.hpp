#pragma once

#include <Eigen/Core>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace sluice::rigid {

// Where a prescribed body is relative to its pose at time 0. World frame.
struct Offset {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();              // [m]
  Eigen::Vector3d rotation = Eigen::Vector3d::Zero();              // about the axis of this vector [rad]
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();              // [m/s]
  Eigen::Vector3d angular_velocity = Eigen::Vector3d::Zero();      // [rad/s]
  Eigen::Vector3d acceleration = Eigen::Vector3d::Zero();          // [m/s^2]
  Eigen::Vector3d angular_acceleration = Eigen::Vector3d::Zero();  // [rad/s^2]
};

// A motion that cannot be used: `part` is the component or key at fault ("x", "key[2].time"; empty: the
// whole).
class MotionError : public std::invalid_argument {
 public:
  MotionError(std::string part, const std::string& text)
      : std::invalid_argument(text), part_(std::move(part)) {}
  [[nodiscard]] const std::string& part() const { return part_; }

 private:
  std::string part_;
};

// A prescribed motion. Its rotation keeps one axis, so that the rotation vector's derivative is the angular
// velocity.
class Motion {
 public:
  virtual ~Motion() = default;
  // At t >= 0 [s]. Throws MotionError where the motion is not finite.
  [[nodiscard]] virtual Offset at(double t) const = 0;
};
using MotionPtr = std::shared_ptr<const Motion>;

// At rest until `start` [s], then at constant velocity [m/s] and angular velocity [rad/s].
MotionPtr constant_velocity(const Eigen::Vector3d& velocity, const Eigen::Vector3d& angular_velocity,
                            double start);

struct Key {
  double time = 0;                                     // [s]
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  // offset [m]
  double angle = 0;                                    // offset about z [rad]
};

// Cubic Hermite between the keys, each component monotone between neighbouring keys (no overshoot), with
// continuous velocity; at rest up to the first key and from the last one on. Throws MotionError unless times
// increase strictly from a first one at or after 0.
MotionPtr keyframe_motion(std::vector<Key> keys);

// Offset amplitude * r(tau / build_up) * sin(2 pi frequency tau), tau = t - start, with the smooth step r of
// Ramp, or 1 where build_up is 0; at rest before the start.
struct Sinusoid {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  // amplitude [m]
  double angle = 0;                                    // amplitude about z [rad]
  double frequency = 0;                                // [1/s]
  double start = 0, build_up = 0;                      // [s]
};
MotionPtr sinusoid_motion(const Sinusoid& sinusoid);

// Offset end * r(s), r(s) = 10 s^3 - 15 s^4 + 6 s^5, s from 0 to 1 over the duration: rest to rest with
// continuous acceleration.
struct Ramp {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  // at the end [m]
  double angle = 0;                                    // at the end, about z [rad]
  double start = 0, duration = 0;                      // [s]
};
MotionPtr ramp_motion(const Ramp& ramp);

// The same motion with its rotation about z turned to be about `axis` (a unit vector).
MotionPtr about_axis(MotionPtr motion, const Eigen::Vector3d& axis);

// The same motion with its rotation about a point: `arm` leads from there to the centre of mass at time 0
// [m].
MotionPtr about_pivot(MotionPtr motion, const Eigen::Vector3d& arm);

// Formulas of t [s]; empty: zero. x, y, z in m, angle about z in rad.
struct Formulas {
  std::string x, y, z, angle;
};

// Known: t, pi, and muParser's functions and operators (sin, sqrt, exp, min, a < b ? c : d, ...). Velocity
// and acceleration come from central differences of sixth order (expression_motion.cpp). Throws MotionError
// naming formula, position and token when one does not parse.
MotionPtr expression_motion(const Formulas& formulas);

// Throws MotionError when the motion does not start at offset zero (to 1e-12 m or rad).
void check_starts_at_zero(const Motion& motion);

}  // namespace sluice::rigid
