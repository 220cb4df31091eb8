#pragma once

#include "server/coupling.hpp"
#include "server/stop.hpp"

namespace sluice::server {

// Runs a simulation to its end, or to whatever ends it before. Everyone has been told when it returns.
Outcome run(Simulation& simulation, Sockets& sockets, const Options& options);

}  // namespace sluice::server
