#pragma once

#include <vector>

#include "protocol/scene_file.hpp"

namespace sluice::protocol {

// Everything that can be said of a scene's fields one by one: present, finite, in range, as many entries as
// dimensions, names unique, unused by the dimension. Locations are left to the caller. Geometry (overlaps,
// leaving the domain) is the preflight's, which knows shapes and motions.
std::vector<Problem> check_fields(const Scene& scene);

// The scene with every default filled in (gravity, liquid, domain.min, output.rate, formulation ...).
// Means something only where check_fields finds nothing; harmless elsewhere.
Scene with_defaults(const Scene& scene);

}  // namespace sluice::protocol
