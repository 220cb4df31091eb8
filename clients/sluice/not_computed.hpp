#pragma once

#include <string>
#include <vector>

#include "scene.pb.h"

namespace sluice::clients {

// What a scene, with its defaults, does not need and costs nothing therefore, for people; `is_recorded` says
// whether its frames are.
std::vector<std::string> not_computed(const Scene& scene, bool is_recorded);

}  // namespace sluice::clients
