#pragma once

#include "tests/unit/fluid/setups.hpp"

namespace sluice::fluid {

// Water whose walls and bodies push, boundary_forces.hpp.
inline Scene with_forces(int dimension, double spacing, double gravity, double sound_speed) {
  Scene scene(dimension, spacing, gravity, sound_speed);
  scene.setup.formulation.boundary = BoundaryTreatment::forces;
  return scene;
}

}  // namespace sluice::fluid
