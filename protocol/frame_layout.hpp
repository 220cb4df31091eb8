#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "messages.pb.h"

namespace sluice::protocol {

// An array of a Frame with a row for each particle.
struct ParticleArray {
  std::string name;
  ParticleField field = PARTICLE_FIELD_UNSPECIFIED;  // unspecified: the identity
  Array::Type type = Array::UNKNOWN;
  std::uint64_t components = 1;  // of a row; its shape is [n] where there is one, else [n, components]
};

inline constexpr const char* kParticleId = "fluid/id";

// Those that the scene's Frames have, in their order.
std::vector<ParticleArray> particle_arrays(const Scene& scene);

// Whether the number of particles differs from Frame to Frame; then the first array is kParticleId.
bool particles_vary(const Scene& scene);

// Outputs from one with particles to the next, at least 1; and whether an output has particles.
std::uint64_t particles_every(const Scene& scene);
bool has_particles(const Scene& scene, std::uint64_t output);

}  // namespace sluice::protocol
