#include "clients/sluice/server_link.hpp"

#include <fmt/core.h>

#include "protocol/framing.hpp"
#include "protocol/version.hpp"

namespace sluice::clients {
namespace {

constexpr int kReconnect = 10;  // [ms]; the server may start to listen after this side has connected

zmq::socket_t connect(zmq::context_t& context, zmq::socket_type type, const std::string& endpoint,
                      const std::optional<protocol::ClientKeys>& keys) {
  zmq::socket_t socket = protocol::make_socket(context, type);
  if (keys) keys->secure(socket);
  socket.set(zmq::sockopt::reconnect_ivl, kReconnect);
  socket.connect(endpoint);
  return socket;
}

}  // namespace

ServerLink::ServerLink(zmq::context_t& context, const protocol::Endpoint& endpoint,
                       const std::optional<protocol::ClientKeys>& keys, bool frames)
    : exchange_(connect(context, zmq::socket_type::dealer, endpoint.exchange, keys)),
      publish_(connect(context, zmq::socket_type::sub, endpoint.publish, keys)) {
  publish_.set(zmq::sockopt::subscribe, "status");
  if (frames) publish_.set(zmq::sockopt::subscribe, "frame");
  protocol::Message hello;
  hello.header.set_protocol_version(protocol::kProtocolVersion);
  hello.header.mutable_hello()->set_role(WATCHER);
  hello.header.mutable_hello()->set_program("sluice");
  protocol::send(exchange_, hello);
}

zmq::pollitem_t ServerLink::greeting_poll() {
  return {exchange_.handle(), 0, ZMQ_POLLIN, 0};
}
zmq::pollitem_t ServerLink::news_poll() {
  return {publish_.handle(), 0, ZMQ_POLLIN, 0};
}

std::optional<Welcome> ServerLink::welcome() {
  while (auto received = protocol::receive(exchange_)) {
    Header& header = received->message.header;
    if (header.has_refusal())
      throw protocol::ProtocolError("the server refused: " + header.refusal().reason());
    if (header.has_welcome()) return std::move(*header.mutable_welcome());
  }
  return std::nullopt;
}

std::optional<Header> ServerLink::news() {
  if (auto received = protocol::receive(publish_)) return std::move(received->message.header);
  return std::nullopt;
}

}  // namespace sluice::clients
