#pragma once

#include "benchmark/speed.hpp"
#include "benchmark/speed_scenes.hpp"

namespace sluice::benchmark {

// How long a scene is stepped.
struct SpeedEffort {
  double warm_up, timed;  // particle steps
};

// Steps a scene and measures it; `peak` is that of one core [1/s].
SpeedRow run_for_speed(const SpeedScene& scene, double particles, int threads, const SpeedEffort& effort,
                       double peak);

}  // namespace sluice::benchmark
