#pragma once

#include <span>
#include <vector>

#include "server/simulation.hpp"

namespace sluice::server {

inline constexpr std::size_t kProbeRow = 6;

// The scene's probes in the present state, a row each (messages.proto, Frame). `kinematics` are the bodies'
// rows.
std::vector<double> probe_rows(const Simulation& simulation, std::span<const double> kinematics);

}  // namespace sluice::server
