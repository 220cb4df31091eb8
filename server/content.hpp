#pragma once

#include <span>

#include "protocol/endpoint.hpp"
#include "protocol/message.hpp"
#include "server/simulation.hpp"

namespace sluice::server {

// What the server tells its peers; run id, token and times are added where the message is sent.

// The Welcome for a role, and for a RIGID of its owner, with the arrays that messages.proto names for it.
protocol::Message welcome(const Simulation& simulation, const protocol::Endpoint& endpoint, Role role,
                          const std::string& owner = {});

// The state after `step`, an output step. `kinematics` are the bodies' rows over it.
protocol::Message frame(const Simulation& simulation, std::uint64_t step, std::span<const double> kinematics);

protocol::Message status(std::uint64_t step, std::uint64_t steps, double wall_seconds,
                         double steps_per_second);

protocol::Message end(std::uint64_t step, End::Reason reason, const std::string& detail, double wall_seconds);

}  // namespace sluice::server
