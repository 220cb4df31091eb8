#include "server/session.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <random>
#include <vector>

#include "protocol/version.hpp"

namespace sluice::server {

namespace {

using protocol::Message;

// Names a role in messages to people.
std::string name_of(Role role) {
  switch (role) {
    case RIGID:
      return "the rigid process";
    case RECORDER:
      return "the recorder";
    case WATCHER:
      return "a watcher";
    default:
      return "a peer without a role";
  }
}

// 64 bits nobody can guess; never 0, which is what an absent token reads as.
std::uint64_t random_bits() {
  std::random_device device;
  const std::uint64_t bits = (std::uint64_t{device()} << 32) | device();
  return bits == 0 ? 1 : bits;
}

}  // namespace

Session::Session(zmq::socket_t& router, Needs needs, Greeting greeting, const std::string& run_id)
    : router_(router),
      needs_(needs),
      greeting_(std::move(greeting)),
      run_id_(run_id.empty() ? fmt::format("{:016x}", random_bits()) : run_id) {}

bool Session::complete() const {
  return (!needs_.rigid || present(RIGID)) && (!needs_.recorder || present(RECORDER));
}

Session::Peers::const_iterator Session::holder(Role role) const {
  return std::find_if(peers_.begin(), peers_.end(),
                      [role](const auto& entry) { return entry.second.role == role; });
}

bool Session::serve(const std::function<void(const Inbound&)>& handle) {
  std::optional<protocol::Received> received;
  try {
    received = protocol::receive(router_);
  } catch (const protocol::ProtocolError& error) {
    // Anyone can send anything to a socket: what is not a message is dropped, and the run goes on.
    complain(fmt::format("dropped a message: {}", error.what()));
    return true;
  }
  if (!received) return false;
  const std::string identity = received->identity;
  try {
    if (const std::optional<Inbound> inbound = admit(std::move(*received))) handle(*inbound);
  } catch (const Refused& refused) {
    refuse(identity, refused);
  }
  return true;
}

std::optional<Session::Inbound> Session::admit(protocol::Received received) {
  const Header& header = received.message.header;
  if (header.protocol_version() != protocol::kProtocolVersion) {
    throw Refused(Refusal::VERSION_MISMATCH,
                  fmt::format("protocol version {} is not {}, this server's; use programs of one build",
                              header.protocol_version(), protocol::kProtocolVersion));
  }
  if (header.has_hello()) return greet(received.identity, std::move(received.message));

  const auto peer = peers_.find(received.identity);
  if (peer == peers_.end() || header.session_token() != peer->second.token || header.run_id() != run_id_) {
    throw Refused(Refusal::BAD_TOKEN,
                  fmt::format("run id \"{}\" and token are not those of a Welcome on this "
                              "connection to run {}; say Hello first",
                              header.run_id(), run_id_));
  }
  if (header.has_heartbeat()) {
    Message answer;
    answer.header.mutable_heartbeat();
    deliver(received.identity, answer);  // heartbeat() notices who is gone
    return std::nullopt;
  }
  return Inbound{peer->second.role, std::move(received.message)};
}

// A Hello that comes again on the same connection gets its Welcome again and changes nothing.
std::optional<Session::Inbound> Session::greet(const std::string& identity, Message hello) {
  const Role role = hello.header.hello().role();
  check_role(identity, role);
  const std::string& program = hello.header.hello().program();
  const bool joined = peers_.try_emplace(identity, Peer{role, random_bits(), program, {}}).second;

  Message welcome = greeting_(role);
  if (!deliver(identity, welcome)) {
    lose(identity);
    return std::nullopt;
  }
  if (!joined) return std::nullopt;
  spdlog::info("{} joined ({})", name_of(role), program);
  return Inbound{role, std::move(hello)};
}

void Session::check_role(const std::string& identity, Role role) {
  if (role != RIGID && role != RECORDER && role != WATCHER) {
    throw Refused(Refusal::BAD_MESSAGE,
                  fmt::format("role {} is none of RIGID, RECORDER, WATCHER", static_cast<int>(role)));
  }
  if (role == RIGID && !needs_.rigid) throw Refused(Refusal::NOT_NEEDED, "the scene has no bodies");
  if (role == RECORDER && !needs_.recorder) {
    throw Refused(Refusal::NOT_NEEDED, "no recorder is expected; start the server with --expect-recorder");
  }
  if (const auto peer = peers_.find(identity); peer != peers_.end()) {
    if (peer->second.role == role) return;
    throw Refused(Refusal::BAD_MESSAGE,
                  fmt::format("this connection has the role {} already", Role_Name(peer->second.role)));
  }
  const auto taken = holder(role);
  if (role == WATCHER || taken == peers_.end()) return;
  // A holder that is gone is noticed here at the latest.
  Message probe;
  probe.header.mutable_heartbeat();
  const std::string holder_identity = taken->first;
  if (deliver(holder_identity, probe)) {
    throw Refused(Refusal::ROLE_TAKEN,
                  fmt::format("{} of this run is {} already", name_of(role), taken->second.program));
  }
  lose(holder_identity);
}

bool Session::deliver(const std::string& identity, Message& message) {
  message.header.set_protocol_version(protocol::kProtocolVersion);
  message.header.set_run_id(run_id_);
  if (const auto peer = peers_.find(identity); peer != peers_.end()) {
    message.header.set_session_token(peer->second.token);
  }
  return protocol::send(router_, message, identity);
}

void Session::send(Role role, Message message) {
  const auto peer = holder(role);
  if (peer == peers_.end()) return;
  const std::string identity = peer->first;
  if (!deliver(identity, message)) lose(identity);
}

void Session::refuse(Role role, const Refused& refused) {
  const auto peer = holder(role);
  if (peer == peers_.end()) return;
  const std::string identity = peer->first;
  peers_.at(identity).last_refusal = refused.what();
  refuse(identity, refused);
}

void Session::refuse(const std::string& identity, const Refused& refused) {
  complain(fmt::format("refused a message: {} - {}", Refusal::Code_Name(refused.code()), refused.what()));
  Message refusal;
  refusal.header.mutable_refusal()->set_code(refused.code());
  refusal.header.mutable_refusal()->set_reason(refused.what());
  deliver(identity, refusal);  // who is gone need not be told
}

void Session::heartbeat(std::chrono::milliseconds interval) {
  const auto now = std::chrono::steady_clock::now();
  if (now - last_heartbeat_ < interval) return;
  last_heartbeat_ = now;
  std::vector<std::string> lost;
  for (auto& [identity, peer] : peers_) {
    Message message;
    message.header.mutable_heartbeat();
    if (deliver(identity, message)) continue;
    // What it sent before it went may still wait to be read, e.g. a recorder's last acknowledgement.
    if (peer.unreachable) lost.push_back(identity);
    peer.unreachable = true;
  }
  for (const std::string& identity : lost) lose(identity);
}

void Session::lose(const std::string& identity) {
  const auto entry = peers_.find(identity);
  if (entry == peers_.end()) return;
  const Peer peer = entry->second;
  peers_.erase(entry);
  if (peer.role == WATCHER) return;

  std::string text = fmt::format("{} ({}) is gone", name_of(peer.role), peer.program);
  if (!peer.last_refusal.empty()) text += "; it was last refused a message: " + peer.last_refusal;
  if (peer.role == RECORDER && state_ != State::WAITING) throw Stop(End::RECORDER_LOST, text);
  if (peer.role == RIGID && state_ == State::RUNNING) throw Stop(End::PARTICIPANT_LOST, text);
  spdlog::warn("{}", text);
}

// A peer that sends nonsense without end must not fill the log.
void Session::complain(const std::string& text) {
  constexpr int kMost = 100;
  if (++complaints_ <= kMost) spdlog::warn("{}", text);
  if (complaints_ == kMost) spdlog::warn("further messages of this kind are not logged");
}

}  // namespace sluice::server
