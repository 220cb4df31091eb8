#pragma once

#include <vector>

#include "fluid/setup.hpp"
#include "scene.pb.h"

namespace sluice::server {

// Of a scene with its defaults. Their formulas throw Stop (UNSTABLE) where they are not finite.
std::vector<fluid::Opening> to_openings(const Scene& scene);

}  // namespace sluice::server
