#pragma once

#include <tuple>
#include <vector>

#include "fluid/kinematics.hpp"
#include "fluid/types.hpp"

namespace sluice::fluid {

// What integrators keep of earlier stages and steps, by Particles::id, so that sorting does not touch it.
// Empty where the integrator needs none.
template <int Dim>
struct History {
  std::vector<Vec<Dim>> velocity;       // [m/s]
  std::vector<Vec<Dim>> way;            // moved since [m]
  std::vector<double> density;          // change of it since, reversed [kg/m^3]
  std::vector<Vec<Dim>> acceleration1;  // one step ago [m/s^2]
  std::vector<Vec<Dim>> acceleration2;  // two steps ago

  auto state() { return std::tie(velocity, way, density, acceleration1, acceleration2); }
};

// Motion in the middle of a step [s] between the states at its ends, of which `to` has the mean velocities.
inline Kinematics halfway(const Kinematics& from, const Kinematics& to, double dt) {
  Kinematics k = to;
  k.acceleration = 0.5 * (from.acceleration + to.acceleration);
  k.angular_acceleration = 0.5 * (from.angular_acceleration + to.angular_acceleration);
  k.position = 0.5 * (from.position + to.position) - dt * dt / 8.0 * k.acceleration;
  k.orientation = from.orientation.slerp(0.5, to.orientation);
  return k;
}

}  // namespace sluice::fluid
