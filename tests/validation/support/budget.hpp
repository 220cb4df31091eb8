#pragma once

#include "validation/support/scene_run.hpp"

namespace sluice::validation {

// Mechanical energy of the liquid: kinetic, potential, of compression and of the surface [J].
double energy(const SceneRun& run);

// The largest energy over the lowest before it [J], of the states it looked at.
class EnergyRise {
 public:
  explicit EnergyRise(const SceneRun& run) : start_(energy(run)), lowest_(start_) {}
  void look(const SceneRun& run);
  [[nodiscard]] double start() const { return start_; }
  [[nodiscard]] double most() const { return most_; }

 private:
  double start_, lowest_, most_ = 0;
};

// Particles further than half a spacing under the floor or behind the walls across x, in the plane.
int lost_below_or_beside(const SceneRun& run);

}  // namespace sluice::validation
