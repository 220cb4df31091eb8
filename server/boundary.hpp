#pragma once

#include "fluid/sampling.hpp"
#include "scene.pb.h"

namespace sluice::server {

// Radius of the kernel's support, 2 h [m].
double kernel_support(const fluid::Setup& setup);

// Boundary particles of the tank's walls and of a body as the formulation wants them: layers, or one for
// boundary forces. Throws protocol::InputError where a body is too thin for those.
fluid::Boundary wall_boundary(const fluid::Tank& tank, const fluid::Setup& setup);
fluid::Boundary body_boundary(const Body& body, const fluid::Setup& setup);

}  // namespace sluice::server
