#include "tests/unit/clients/fake_server.hpp"

namespace sluice::clients::test {
namespace {

constexpr int kPatience = 20000;  // [ms] for a client in the same process
constexpr std::uint64_t kToken = 4711;

}  // namespace

FakeServer::FakeServer(const std::string& endpoint)
    : exchange_(protocol::make_socket(context_, zmq::socket_type::router)),
      record_(protocol::make_socket(context_, zmq::socket_type::push)) {
  const auto where = protocol::Endpoint::parse(endpoint);
  protocol::bind(exchange_, where.exchange);
  protocol::bind(record_, where.record);
}

protocol::Message FakeServer::receive() {
  while (auto received = protocol::receive_within(exchange_, kPatience)) {
    client_ = received->identity;
    if (!received->message.header.has_heartbeat()) return std::move(received->message);
    protocol::Message beat;
    beat.header.mutable_heartbeat();
    reply(std::move(beat));
  }
  throw std::runtime_error("the client said nothing");
}

void FakeServer::reply(protocol::Message message) {
  message.header.set_session_token(kToken);
  if (!protocol::send(exchange_, message, client_)) throw std::runtime_error("the client is gone");
}

void FakeServer::push(protocol::Message message) {
  message.header.set_sequence(++pushed_);
  zmq::pollitem_t item{record_.handle(), 0, ZMQ_POLLOUT, 0};
  zmq::poll(&item, 1, std::chrono::milliseconds(kPatience));
  if (!protocol::send(record_, message)) throw std::runtime_error("nobody pulls");
}

void FakeServer::await_acknowledgement(std::uint64_t sequence) {
  std::uint64_t last = 0;
  while (last < sequence) {
    const protocol::Message message = receive();
    if (message.header.session_token() != kToken) throw std::runtime_error("a message without the token");
    last = message.header.acknowledgement().sequence();
  }
}

void FakeServer::vanish() {
  for (zmq::socket_t* socket : {&exchange_, &record_}) {
    socket->set(zmq::sockopt::linger, 0);
    socket->close();
  }
}

}  // namespace sluice::clients::test
