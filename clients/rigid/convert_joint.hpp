#pragma once

#include "rigid/joint.hpp"
#include "scene.pb.h"

namespace sluice::clients {

// A joint of a scene that has passed the checks; bodies by their place in it.
rigid::JointSpec to_joint(const Joint& joint, const Scene& scene);

}  // namespace sluice::clients
