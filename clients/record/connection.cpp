#include "clients/record/connection.hpp"

#include <fmt/format.h>

#include <atomic>
#include <cstring>

#include "protocol/framing.hpp"
#include "protocol/version.hpp"

namespace sluice::clients {
namespace {

using protocol::Message;
using protocol::PeerLost;
using protocol::ProtocolError;
using std::chrono::duration_cast;
using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr seconds kBeat{1};      // between heartbeats
constexpr seconds kSilence{10};  // of a server that answers every heartbeat
constexpr int kWatched = ZMQ_EVENT_DISCONNECTED | ZMQ_EVENT_HANDSHAKE_FAILED_AUTH |
                         ZMQ_EVENT_HANDSHAKE_FAILED_PROTOCOL | ZMQ_EVENT_HANDSHAKE_FAILED_NO_DETAIL;

std::string monitor_address() {
  static std::atomic<int> count{0};
  return fmt::format("inproc://connection-monitor-{}", count++);
}

}  // namespace

void wait_for_any(std::span<zmq::pollitem_t> items, milliseconds timeout) {
  try {
    zmq::poll(items.data(), items.size(), timeout);
  } catch (const zmq::error_t& error) {
    if (error.num() != EINTR) throw;
  }
}

Connection::Connection(zmq::context_t& context, const protocol::Endpoint& endpoint,
                       const std::optional<protocol::ClientKeys>& keys)
    : endpoint_(endpoint.exchange),
      socket_(protocol::make_socket(context, zmq::socket_type::dealer)),
      monitor_(context, zmq::socket_type::pair) {
  const std::string address = monitor_address();
  if (zmq_socket_monitor(socket_.handle(), address.c_str(), kWatched) != 0) throw zmq::error_t();
  monitor_.connect(address);
  if (keys) keys->secure(socket_);
  socket_.connect(endpoint_);
}

Connection::~Connection() {
  zmq_socket_monitor(socket_.handle(), nullptr, 0);
}

void Connection::greet(Role role, const std::string& program, const std::string& owner) {
  Message hello;
  hello.header.mutable_hello()->set_role(role);
  hello.header.mutable_hello()->set_program(program);
  hello.header.mutable_hello()->set_owner(owner);
  send(std::move(hello));
}

void Connection::send(Message message) {
  message.header.set_protocol_version(protocol::kProtocolVersion);
  message.header.set_run_id(run_id_);
  message.header.set_session_token(token_);
  // Hello, Heartbeat and Accepted take no part in a numbered exchange.
  if (!message.header.has_hello() && !message.header.has_heartbeat() && !message.header.has_accepted())
    message.header.set_sequence(++sequence_);
  if (!protocol::send(socket_, message))
    throw PeerLost(fmt::format("the server at {} no longer takes messages", endpoint_));
}

std::optional<Message> Connection::receive() {
  while (auto received = protocol::receive(socket_)) {
    hear();
    const Header& header = received->message.header;
    if (header.has_heartbeat()) continue;
    if (header.has_refusal())
      throw ProtocolError(fmt::format("the server at {} refused ({}): {}", endpoint_,
                                      Refusal::Code_Name(header.refusal().code()),
                                      header.refusal().reason()));
    if (header.has_welcome()) {
      run_id_ = header.run_id();
      token_ = header.session_token();
      welcomed_ = true;
    }
    return std::move(received->message);
  }
  return std::nullopt;
}

void Connection::watch(milliseconds patience) {
  read_monitor();
  if (disconnected_) throw PeerLost(fmt::format("the server at {} closed the connection", endpoint_));
  const auto now = Clock::now();
  const milliseconds limit = welcomed_ ? duration_cast<milliseconds>(kSilence) : patience;
  if (now - heard_ > limit) {
    const char* question = welcomed_ ? "" : "; is a server running there?";
    throw PeerLost(fmt::format("no {} from {} for {:g} s{}", welcomed_ ? "message" : "answer", endpoint_,
                               1e-3 * static_cast<double>(limit.count()),
                               handshake_failure_.empty() ? question : "; " + handshake_failure_));
  }
  if (!welcomed_ || now - beat_ < kBeat) return;
  beat_ = now;
  Message beat;
  beat.header.mutable_heartbeat();
  send(std::move(beat));
}

void Connection::read_monitor() {
  zmq::message_t event, address;
  while (monitor_.recv(event, zmq::recv_flags::dontwait)) {
    (void)monitor_.recv(address, zmq::recv_flags::dontwait);
    std::uint16_t kind = 0;
    std::memcpy(&kind, event.data(), sizeof kind);
    switch (kind) {
      case ZMQ_EVENT_DISCONNECTED:
        disconnected_ = welcomed_;  // before that the transport may still find its way
        break;
      case ZMQ_EVENT_HANDSHAKE_FAILED_AUTH:
        throw ProtocolError(
            fmt::format("the server at {} does not allow this client's key; add its public key to the "
                        "server's allowed keys",
                        endpoint_));
      default:
        handshake_failure_ =
            "something listens there but the handshake fails; do both sides use --keys, or neither?";
    }
  }
}

}  // namespace sluice::clients
