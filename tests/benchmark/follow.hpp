#pragma once

#include <cstdint>
#include <string>

#include "validation/support/scene_run.hpp"

namespace sluice::benchmark {

// What must not happen in a run, whatever the scene.
struct Faults {
  // Why the run ended early, a state that is not finite or cannot be; empty: it did not.
  std::string stop;
  std::uint64_t lost = 0;  // particles further than a spacing behind a closed side
  double lost_at = 0;      // when the first of them was there [s]
  // Largest rise of kinetic + potential + elastic energy less the bodies' work above its least value so far,
  // over the largest kinetic + potential energy of the run, the latter from the tank's floor.
  double energy_rise = 0;
  double rise_at = 0;      // [s]
  std::string rise_where;  // the particle under the highest pressure then: its place and what it is next to
  double compression = 0;  // largest |rho/rho0 - 1|
  std::uint64_t particles = 0, steps = 0;
  double end = 0;  // time reached [s]

  static constexpr double kMostRise = 0.01;
  [[nodiscard]] bool any() const { return !stop.empty() || lost > 0 || energy_rise > kMostRise; }
  // "2 particles lost from t = 0.3 s on; energy has risen by 3.1 % at t = 0.2 s, highest pressure at ...".
  [[nodiscard]] std::string text() const;
};

// Runs to the end, or until the state cannot be followed any more. A particle that has left through an open
// side may go anywhere; a run that stops because one went too far is no fault.
Faults follow(validation::SceneRun& run);

}  // namespace sluice::benchmark
