#pragma once

#include <optional>
#include <string>

#include "protocol/message.hpp"

namespace sluice::protocol {

// What a receiver accepts; anything beyond is a ProtocolError and nothing of it is kept.
struct Limits {
  std::size_t header_bytes = 1 << 20;
  std::size_t frames = 64;
  std::size_t total_bytes = std::size_t{4} << 30;
};

// Sends all frames of the message. Returns false when the socket would block or, on a ROUTER with the
// MANDATORY option, when the peer is gone. `identity` addresses a peer of a ROUTER, or is the topic on an
// XPUB
// ("status" or "frame"); empty otherwise.
bool send(zmq::socket_t& socket, const Message& message, const std::string& identity = {});

struct Received {
  std::string identity;  // of the peer on a ROUTER, the topic on a SUB
  Message message;
};

// The next message, or nothing when none is waiting. Validates: header parses, counts, types and shapes
// agree with the frames, sizes within limits; throws ProtocolError (after draining the whole message).
std::optional<Received> receive(zmq::socket_t& socket, const Limits& limits = {});

// The next message within `timeout_ms`; nothing when it does not come.
std::optional<Received> receive_within(zmq::socket_t& socket, int timeout_ms, const Limits& limits = {});

}  // namespace sluice::protocol
