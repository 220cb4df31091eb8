#pragma once

#include <atomic>
#include <chrono>
#include <optional>
#include <string>
#include <zmq.hpp>

#include "protocol/curve.hpp"
#include "protocol/message.hpp"

namespace sluice::clients {

// The server said no; the text is its reason.
class Refused : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// The user asked this program to stop.
class Interrupted : public std::runtime_error {
 public:
  Interrupted() : std::runtime_error("interrupted") {}
};

// A participant's side of the exchange with the server: handshake, identification of every message, and the
// watch over the server. `stop` is looked at ten times a second while waiting.
class ParticipantLink {
 public:
  ParticipantLink(zmq::context_t& context, const std::string& endpoint,
                  const std::optional<protocol::ClientKeys>& keys, const std::atomic<bool>& stop);
  ~ParticipantLink();
  ParticipantLink(const ParticipantLink&) = delete;
  ParticipantLink& operator=(const ParticipantLink&) = delete;

  // Says Hello and gives the server's Welcome. Throws PeerLost when none answers within 10 s.
  protocol::Message greet(Role role, const std::string& program);

  // Sends with version, run and token filled in.
  void send(protocol::Message message);

  // The next message that is not a heartbeat. Throws Refused; Interrupted; PeerLost when the server has
  // closed the connection or been silent for 10 s, although it answers this side's heartbeats.
  protocol::Message wait();

 private:
  std::optional<protocol::Message> poll();
  void watch_server();
  void read_monitor();

  std::string endpoint_;
  const std::atomic<bool>& stop_;
  zmq::socket_t socket_, monitor_;
  std::string run_id_;
  std::uint64_t token_ = 0;
  bool welcomed_ = false, disconnected_ = false;
  std::string handshake_failure_;
  std::chrono::steady_clock::time_point heard_, beat_;
};

}  // namespace sluice::clients
