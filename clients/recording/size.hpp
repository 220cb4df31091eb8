#pragma once

#include <cstdint>

namespace sluice::clients {

// What the size of a recording depends on.
struct RunSize {
  std::uint64_t fluid_particles = 0, boundary_particles = 0;
  std::uint64_t bodies = 0, probes = 0;
  std::uint64_t frames = 0, steps = 0;
};

// Bytes of the recording of such a run, but for the scene and the file's own structure.
std::uint64_t recording_bytes(const RunSize& run);

}  // namespace sluice::clients
