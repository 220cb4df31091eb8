#include "clients/rigid/participant_link.hpp"

#include <fmt/format.h>

#include <cstring>

#include "protocol/endpoint.hpp"
#include "protocol/framing.hpp"
#include "protocol/version.hpp"

namespace sluice::clients {
namespace {

using Clock = std::chrono::steady_clock;
constexpr int kSlice = 100;                           // [ms] between looks at `stop` and the monitor
constexpr auto kBeat = std::chrono::seconds(1);       // between heartbeats while waiting
constexpr auto kPatience = std::chrono::seconds(10);  // with a silent server
constexpr int kWatched = ZMQ_EVENT_DISCONNECTED | ZMQ_EVENT_HANDSHAKE_FAILED_AUTH |
                         ZMQ_EVENT_HANDSHAKE_FAILED_PROTOCOL | ZMQ_EVENT_HANDSHAKE_FAILED_NO_DETAIL;

std::string monitor_address() {
  static std::atomic<int> count{0};
  return fmt::format("inproc://participant-monitor-{}", count++);
}

}  // namespace

ParticipantLink::ParticipantLink(zmq::context_t& context, const std::string& endpoint,
                                 const std::optional<protocol::ClientKeys>& keys,
                                 const std::atomic<bool>& stop)
    : endpoint_(protocol::Endpoint::parse(endpoint, keys.has_value()).exchange),
      stop_(stop),
      socket_(protocol::make_socket(context, zmq::socket_type::dealer)),
      monitor_(context, zmq::socket_type::pair) {
  const std::string address = monitor_address();
  if (zmq_socket_monitor(socket_.handle(), address.c_str(), kWatched) != 0) throw zmq::error_t();
  monitor_.connect(address);
  if (keys) keys->secure(socket_);
  socket_.connect(endpoint_);
}

ParticipantLink::~ParticipantLink() {
  zmq_socket_monitor(socket_.handle(), nullptr, 0);
}

protocol::Message ParticipantLink::greet(Role role, const std::string& program) {
  heard_ = beat_ = Clock::now();
  protocol::Message hello;
  hello.header.mutable_hello()->set_role(role);
  hello.header.mutable_hello()->set_program(program);
  hello.header.mutable_hello()->set_gives_state(role == RIGID);
  send(std::move(hello));
  protocol::Message answer = wait();
  if (!answer.header.has_welcome())
    throw protocol::ProtocolError(
        fmt::format("the server at {} answered the greeting with content {} instead of a "
                    "welcome",
                    endpoint_, static_cast<int>(answer.header.content_case())));
  run_id_ = answer.header.run_id();
  token_ = answer.header.session_token();
  welcomed_ = true;
  return answer;
}

void ParticipantLink::send(protocol::Message message) {
  message.header.set_protocol_version(protocol::kProtocolVersion);
  message.header.set_run_id(run_id_);
  message.header.set_session_token(token_);
  if (!protocol::send(socket_, message))
    throw protocol::PeerLost(fmt::format("the server at {} no longer takes messages", endpoint_));
}

protocol::Message ParticipantLink::wait() {
  heard_ = Clock::now();  // the time this side spent on its own work is not the server's silence
  while (true) {
    if (auto message = poll()) return std::move(*message);
    if (stop_) throw Interrupted();
    read_monitor();
    if (!disconnected_) {
      watch_server();
      continue;
    }
    // What the server sent before it closed the connection counts.
    if (auto message = poll()) return std::move(*message);
    throw protocol::PeerLost(fmt::format("the server at {} closed the connection", endpoint_));
  }
}

std::optional<protocol::Message> ParticipantLink::poll() {
  auto received = protocol::receive_within(socket_, kSlice);
  if (!received) return std::nullopt;
  heard_ = Clock::now();
  Header& header = received->message.header;
  if (header.has_heartbeat()) return std::nullopt;
  if (header.has_refusal()) throw Refused(header.refusal().reason());
  return std::move(received->message);
}

void ParticipantLink::watch_server() {
  const auto now = Clock::now();
  if (now - heard_ > kPatience)
    throw protocol::PeerLost(fmt::format(
        "no {} from {} for {} s{}", welcomed_ ? "message" : "answer", endpoint_, kPatience.count(),
        handshake_failure_.empty() ? "; is a server running there?" : "; " + handshake_failure_));
  if (welcomed_ && now - beat_ > kBeat) {
    protocol::Message beat;
    beat.header.mutable_heartbeat();
    send(std::move(beat));
    beat_ = now;
  }
}

void ParticipantLink::read_monitor() {
  zmq::message_t event, address;
  while (monitor_.recv(event, zmq::recv_flags::dontwait)) {
    (void)monitor_.recv(address, zmq::recv_flags::dontwait);
    std::uint16_t kind = 0;
    std::memcpy(&kind, event.data(), sizeof kind);
    // Before the welcome the transport may still find its way to the server.
    if (kind == ZMQ_EVENT_DISCONNECTED) disconnected_ = welcomed_;
    if (kind == ZMQ_EVENT_HANDSHAKE_FAILED_AUTH)
      throw Refused(
          fmt::format("the server at {} does not allow this client's key; add its public key to the server's "
                      "allowed keys",
                      endpoint_));
    if (kind == ZMQ_EVENT_HANDSHAKE_FAILED_PROTOCOL || kind == ZMQ_EVENT_HANDSHAKE_FAILED_NO_DETAIL)
      handshake_failure_ =
          "something listens there but the handshake fails; do both sides use --keys, or neither?";
  }
}

}  // namespace sluice::clients
