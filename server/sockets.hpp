#pragma once

#include <optional>

#include "protocol/curve.hpp"
#include "protocol/endpoint.hpp"

namespace sluice::server {

// The server's three sockets, listening.
class Sockets {
 public:
  // With keys only the clients they allow may connect. Throws InputError when the endpoint is in use or may
  // not be bound.
  explicit Sockets(const protocol::Endpoint& where, const std::optional<protocol::ServerKeys>& keys = {})
      : endpoint(where), lock_(where) {
    if (keys) {
      authenticator_.emplace(context_, *keys);
      for (zmq::socket_t* socket : {&exchange, &publish, &record}) authenticator_->secure(*socket);
    }
    protocol::bind(exchange, endpoint.exchange);
    protocol::bind(publish, endpoint.publish);
    protocol::bind(record, endpoint.record);
  }

  const protocol::Endpoint endpoint;

 private:
  protocol::EndpointLock lock_;
  zmq::context_t context_;
  std::optional<protocol::Authenticator> authenticator_;  // outlives the sockets

 public:
  zmq::socket_t exchange = protocol::make_socket(context_, zmq::socket_type::router);
  zmq::socket_t publish = protocol::make_socket(context_, zmq::socket_type::xpub);
  zmq::socket_t record = protocol::make_socket(context_, zmq::socket_type::push);
};

}  // namespace sluice::server
