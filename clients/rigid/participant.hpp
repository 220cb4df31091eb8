#pragma once

#include <atomic>
#include <optional>
#include <string>

#include "messages.pb.h"
#include "protocol/curve.hpp"

namespace sluice::clients {

// Takes part in a run as its rigid process, to the End that the server sends. Poses of prescribed bodies are
// streamed ahead; with a free body every step waits for its wrenches. Throws InputError (scene or endpoint
// not usable), Refused, PeerLost, ProtocolError, Interrupted, and std::runtime_error when a body cannot be
// integrated.
End take_part_as_rigid(const std::string& endpoint, const std::optional<protocol::ClientKeys>& keys,
                       const std::atomic<bool>& stop);

}  // namespace sluice::clients
