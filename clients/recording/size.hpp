#pragma once

#include <cstdint>

#include "scene.pb.h"

namespace sluice::clients {

// What the size of a recording depends on.
struct RunSize {
  Scene scene;
  std::uint64_t fluid_particles = 0;  // in a frame
  std::uint64_t boundary_particles = 0;
  std::uint64_t frames = 0, steps = 0;
};

// Of the liquid's particles those that may be in a frame at once: no more than fill the scene's
// output.region.
std::uint64_t most_recorded(const Scene& scene, std::uint64_t fluid_particles);

// Bytes of the recording of such a run, but for the scene and the file's own structure.
std::uint64_t recording_bytes(const RunSize& run);

}  // namespace sluice::clients
