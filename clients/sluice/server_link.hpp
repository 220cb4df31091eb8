#pragma once

#include <functional>
#include <optional>
#include <string>
#include <zmq.hpp>

#include "protocol/curve.hpp"
#include "protocol/endpoint.hpp"
#include "protocol/message.hpp"

namespace sluice::clients {

// The front end's connection to the server it started: a watcher like any other. It may be made before the
// server listens; the greeting is delivered as soon as it does.
class ServerLink {
 public:
  // `frames`: also receive the frames, whose headers carry the energies.
  ServerLink(zmq::context_t& context, const protocol::Endpoint& endpoint,
             const std::optional<protocol::ClientKeys>& keys, bool frames);

  // For polling.
  [[nodiscard]] zmq::pollitem_t greeting_poll();
  [[nodiscard]] zmq::pollitem_t news_poll();

  // The server's answer, once. Throws ProtocolError when it refuses.
  std::optional<Welcome> welcome();
  // The next Status, Frame or End header that has arrived.
  std::optional<Header> news();

 private:
  zmq::socket_t exchange_;
  zmq::socket_t publish_;
};

}  // namespace sluice::clients
