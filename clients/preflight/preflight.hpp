#pragma once

#include <cstdint>
#include <vector>

#include "protocol/scene_file.hpp"

namespace sluice::clients {

// What a run will cost; estimate.cpp says how. Particles to a few per cent, steps exactly, memory of all
// processes and run time of one thread to a factor of about two.
struct Estimate {
  std::uint64_t fluid_particles = 0;
  std::uint64_t boundary_particles = 0;
  std::uint64_t steps = 0, frames = 0;
  std::uint64_t memory_bytes = 0;
  double run_seconds = 0;
};

// Everything about a scene that its fields one by one do not show.
struct Preflight {
  std::vector<protocol::Problem> errors;    // the scene must not run
  std::vector<protocol::Problem> warnings;  // it may run, and its result is likely to disappoint
  Estimate estimate;                        // complete only without errors
};

Preflight preflight(const protocol::SceneFile& file);

}  // namespace sluice::clients
