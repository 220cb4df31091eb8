#include "clients/recording/selection.hpp"

#include <fmt/format.h>

#include "clients/recording/layout.hpp"

namespace sluice::clients {

std::string selection_text(const Reader& recording) {
  const Scene& scene = recording.scene();
  if (!layout::selects(scene)) return "";
  std::string names;
  for (const protocol::ParticleArray& array : protocol::particle_arrays(scene))
    if (array.field != PARTICLE_FIELD_UNSPECIFIED)
      names += (names.empty() ? "" : ", ") + array.name.substr(array.name.find('/') + 1);
  const Output& output = scene.output();
  std::string text = names + (output.precision() == FLOAT32 ? " in single precision" : "");
  if (const std::uint64_t every = protocol::particles_every(scene); every > 1)
    text += fmt::format(", of frames 0, {}, {} ...", every, 2 * every);
  if (output.has_region())
    text += fmt::format("; up to {} particles at a time, from ({:g}) to ({:g}) m", recording.slots(),
                        fmt::join(output.region().min(), ", "), fmt::join(output.region().max(), ", "));
  return text;
}

}  // namespace sluice::clients
