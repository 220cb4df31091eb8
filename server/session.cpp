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

// 64 bits nobody can guess; never 0, which is what an absent token reads as.
std::uint64_t random_bits() {
  std::random_device device;
  const std::uint64_t bits = (std::uint64_t{device()} << 32) | device();
  return bits == 0 ? 1 : bits;
}

}  // namespace

std::string name_of(const Session::Seat& seat) {
  switch (seat.role) {
    case RIGID:
      return seat.owner.empty() ? "the rigid process" : fmt::format("the owner '{}' of bodies", seat.owner);
    case RECORDER:
      return "the recorder";
    case WATCHER:
      return "a watcher";
    default:
      return "a peer without a role";
  }
}

Session::Session(zmq::socket_t& router, Needs needs, Greeting greeting, const std::string& run_id)
    : router_(router),
      needs_(std::move(needs)),
      greeting_(std::move(greeting)),
      run_id_(run_id.empty() ? fmt::format("{:016x}", random_bits()) : run_id) {}

bool Session::complete() const {
  const bool moved =
      std::all_of(needs_.owners.begin(), needs_.owners.end(), [this](const std::string& owner) {
        return present({RIGID, owner});
      });
  return moved && (!needs_.recorder || present(RECORDER));
}

Session::Peers::const_iterator Session::holder(const Seat& seat) const {
  return std::find_if(peers_.begin(), peers_.end(),
                      [&seat](const auto& entry) { return entry.second.seat == seat; });
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
  return Inbound{peer->second.seat, std::move(received.message)};
}

// A Hello that comes again on the same connection gets its Welcome again and changes nothing.
std::optional<Session::Inbound> Session::greet(const std::string& identity, Message hello) {
  const Hello& content = hello.header.hello();
  const Seat seat(content.role(), content.role() == RIGID ? content.owner() : std::string());
  check_seat(identity, seat);
  const std::string& program = content.program();
  const bool joined = peers_.try_emplace(identity, Peer{seat, random_bits(), program, {}}).second;

  Message welcome = greeting_(seat);
  if (!deliver(identity, welcome)) {
    lose(identity);
    return std::nullopt;
  }
  if (!joined) return std::nullopt;
  spdlog::info("{} joined ({})", name_of(seat), program);
  return Inbound{seat, std::move(hello)};
}

// Throws Refused where nobody is wanted in that seat.
void Session::check_need(const Seat& seat) const {
  if (seat.role != RIGID && seat.role != RECORDER && seat.role != WATCHER)
    throw Refused(Refusal::BAD_MESSAGE,
                  fmt::format("role {} is none of RIGID, RECORDER, WATCHER", static_cast<int>(seat.role)));
  if (seat.role == RECORDER && !needs_.recorder)
    throw Refused(Refusal::NOT_NEEDED, "no recorder is expected; start the server with --expect-recorder");
  const std::vector<std::string>& owners = needs_.owners;
  if (seat.role != RIGID || std::find(owners.begin(), owners.end(), seat.owner) != owners.end()) return;
  if (owners.empty()) throw Refused(Refusal::NOT_NEEDED, "the scene has no bodies");
  if (seat.owner.empty())
    throw Refused(Refusal::NOT_NEEDED,
                  fmt::format("every body of the scene has an owner: {}; say in Hello which one this is",
                              fmt::join(owners, ", ")));
  throw Refused(Refusal::NOT_NEEDED, fmt::format("no body of the scene has the owner '{}'", seat.owner));
}

void Session::check_seat(const std::string& identity, const Seat& seat) {
  check_need(seat);
  if (const auto peer = peers_.find(identity); peer != peers_.end()) {
    if (peer->second.seat == seat) return;
    throw Refused(Refusal::BAD_MESSAGE,
                  fmt::format("this connection is {} already", name_of(peer->second.seat)));
  }
  const auto taken = holder(seat);
  if (seat.role == WATCHER || taken == peers_.end()) return;
  // A holder that is gone is noticed here at the latest.
  Message probe;
  probe.header.mutable_heartbeat();
  const std::string holder_identity = taken->first;
  if (deliver(holder_identity, probe)) {
    throw Refused(Refusal::ROLE_TAKEN,
                  fmt::format("{} of this run is {} already", name_of(seat), taken->second.program));
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

void Session::send(const Seat& seat, Message message) {
  const auto peer = holder(seat);
  if (peer == peers_.end()) return;
  const std::string identity = peer->first;
  if (!deliver(identity, message)) lose(identity);
}

void Session::refuse(const Seat& seat, const Refused& refused) {
  const auto peer = holder(seat);
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
  const Role role = peer.seat.role;
  if (role == WATCHER) return;

  std::string text = fmt::format("{} ({}) is gone", name_of(peer.seat), peer.program);
  if (!peer.last_refusal.empty()) text += "; it was last refused a message: " + peer.last_refusal;
  if (role == RECORDER && state_ != State::WAITING) throw Stop(End::RECORDER_LOST, text);
  if (role == RIGID && state_ == State::RUNNING) throw Stop(End::PARTICIPANT_LOST, text);
  spdlog::warn("{}", text);
}

// A peer that sends nonsense without end must not fill the log.
void Session::complain(const std::string& text) {
  constexpr int kMost = 100;
  if (++complaints_ <= kMost) spdlog::warn("{}", text);
  if (complaints_ == kMost) spdlog::warn("further messages of this kind are not logged");
}

}  // namespace sluice::server
