#pragma once

#include "validation/support/scene_run.hpp"

namespace sluice::validation {

// Of a gate whose left face is at the water's edge, foot on the floor, as in rising_gate.scene and
// thin_gate.scene.
struct Gate {
  double left, right, half_height;  // [m]

  [[nodiscard]] double foot(const SceneRun& run) const { return run.body(0).position.y() - half_height; }

  // Liquid inside the gate, or on its dry side higher than the opening: it can only have come through the
  // gate.
  [[nodiscard]] int leaked(const SceneRun& run) const {
    const fluid::Snapshot s = run.solver().snapshot();
    const double spacing = run.scene().spacing(), above_opening = foot(run) + spacing;
    int count = 0;
    for (std::size_t i = 0; i < s.density.size(); ++i) {
      const double x = s.position[3 * i], y = s.position[3 * i + 1];
      count += y > above_opening && x > left && x < right + 3 * spacing;
    }
    return count;
  }
};

}  // namespace sluice::validation
