#pragma once

#include <functional>

#include "rigid/world.hpp"

namespace sluice::rigid {

// Steps a world without any liquid; `look` is called after every step.
inline void run(World& simulated, int steps, double dt, const std::function<void()>& look = {}) {
  const std::vector<Wrench> none(simulated.size());
  for (int n = 1; n <= steps; ++n) {
    simulated.predict(n * dt, dt);
    simulated.correct(dt, none);
    if (look) look();
  }
}

}  // namespace sluice::rigid
