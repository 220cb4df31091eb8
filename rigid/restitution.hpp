#pragma once

#include <limits>
#include <span>
#include <vector>

#include "rigid/free_body.hpp"

namespace sluice::rigid {

constexpr std::size_t kWall = std::numeric_limits<std::size_t>::max();

// A point where two bodies, or a body and a wall (kWall), came to touch in a drift.
struct Touch {
  std::size_t a = kWall, b = kWall;
  Eigen::Vector3d arm_a = Eigen::Vector3d::Zero(), arm_b = Eigen::Vector3d::Zero();  // from the centres [m]
  Eigen::Vector3d normal = Eigen::Vector3d::UnitX();                                 // from b to a
  double gap = 0;  // at the start of the drift [m]; negative where it was missed so far
  double friction = 0, restitution = 0;
  bool is_impact = false;  // met with more than what a step's forces do to a body at rest
  double when = 0;         // the share of the drift after which they met; negative: before it
  double rebound = 0;      // normal speed over the drift that goes with the rebound [m/s]
};

// Whether the two touch at the end of an inelastic drift.
bool is_closed(const Touch& touch, std::span<const FreeBody::Drift> before,
               std::span<const FreeBody::Drift> after, double dt);

// Sets the last three from the velocities before contact. A body that met at the time `when` of the step has
// there the normal velocity u = v + a_n (when - 1/2) dt, leaves with -e u, and over the step with
// -e u + a_n (1/2 - when) dt, v and a_n the relative normal velocity and acceleration. An impact is one with
// |v| > 4 dt |a_n|: bodies that rest on each other meet at dt |a_n| / 2 in every step.
void find_impact(Touch& touch, std::span<const FreeBody::Drift> before, double dt);

struct Inertia {
  Eigen::Vector3d inverse_mass = Eigen::Vector3d::Zero();     // along the world's axes [1/kg]
  Eigen::Matrix3d inverse_inertia = Eigen::Matrix3d::Zero();  // world frame [1/(kg m^2)]
};

// Newton's law of impact: impulses along the normals, found by projected Gauss-Seidel, that give every impact
// its rebound and push no other touch together; with Coulomb friction of those impulses. In: the inelastic
// result of the drift that began with `before`. Out: velocities after the rebound and the poses that they
// lead to.
void throw_back(double dt, std::span<const Touch> touches, std::span<const Inertia> inertia,
                std::span<const FreeBody::Drift> before, std::span<FreeBody::Drift> bodies);

}  // namespace sluice::rigid
