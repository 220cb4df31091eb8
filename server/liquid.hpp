#pragma once

#include "fluid/setup.hpp"
#include "protocol/scene_file.hpp"

namespace sluice::server {

// The liquid at the start: every region filled with a lattice, cut where a body displaces it, under
// hydrostatic pressure. `scene` has its defaults filled in. Throws SceneError naming the region or body when
// regions overlap, leave the tank, hold no particle, or a body that does not displace liquid stands in it.
fluid::FluidParticles fill_liquid(const Scene& scene);

}  // namespace sluice::server
