#include "protocol/frame_layout.hpp"

#include <algorithm>

namespace sluice::protocol {
namespace {

bool is_wanted(const Output& output, ParticleField field) {
  const auto& fields = output.field();
  return fields.empty() || field == POSITION ||
         std::find(fields.begin(), fields.end(), field) != fields.end();
}

}  // namespace

std::vector<ParticleArray> particle_arrays(const Scene& scene) {
  const Output& output = scene.output();
  const Array::Type real = output.precision() == FLOAT32 ? Array::FLOAT32 : Array::FLOAT64;
  std::vector<ParticleArray> arrays;
  if (particles_vary(scene)) arrays.push_back({kParticleId, PARTICLE_FIELD_UNSPECIFIED, Array::INT64, 1});
  const auto add = [&](ParticleField field, const char* name, std::uint64_t components) {
    if (is_wanted(output, field)) arrays.push_back({name, field, real, components});
  };
  add(POSITION, "fluid/position", 3);
  add(VELOCITY, "fluid/velocity", 3);
  add(DENSITY, "fluid/density", 1);
  add(PRESSURE, "fluid/pressure", 1);
  if (scene.other_liquid_size() > 0 && is_wanted(output, LIQUID))
    arrays.push_back({"fluid/liquid", LIQUID, Array::INT64, 1});
  return arrays;
}

bool particles_vary(const Scene& scene) {
  return scene.output().has_region() || scene.opening_size() > 0;
}

std::uint64_t particles_every(const Scene& scene) {
  return std::max<std::uint64_t>(scene.output().particles_every(), 1);
}

bool has_particles(const Scene& scene, std::uint64_t output) {
  return output % particles_every(scene) == 0;
}

}  // namespace sluice::protocol
