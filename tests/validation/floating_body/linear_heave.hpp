#pragma once

#include "validation/support/curve.hpp"

namespace sluice::validation {

// A box in the middle of a closed tank, two dimensions; lengths [m].
struct HeavingBox {
  double tank = 1.6, depth = 0.8, width = 0.6, draft = 0.12;
  double lift = 0.02;  // of the box at rest at time 0, the surface being level
};

// Its height above the draft of rest [m] over time [s], by linear potential theory: the free surface at the
// undisturbed level, walls and added mass included. Laplace's equation on cells of `cell`, which divides all
// lengths; fourth-order Runge - Kutta.
Curve linear_heave(const HeavingBox& box, double cell, double duration);

}  // namespace sluice::validation
