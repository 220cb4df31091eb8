#pragma once

#include "fluid/solver.hpp"
#include "protocol/message.hpp"

namespace sluice::server {

// Adds to a Frame the arrays of particles that the scene's output asks for (protocol/frame_layout.hpp), of
// the particles that it asks for.
void add_particles(protocol::Message& frame, const Scene& scene, const fluid::Snapshot& state);

}  // namespace sluice::server
