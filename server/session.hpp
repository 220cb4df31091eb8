#pragma once

#include <chrono>
#include <functional>
#include <map>
#include <optional>
#include <string>

#include "protocol/framing.hpp"
#include "server/stop.hpp"

namespace sluice::server {

// Who takes part: roles, tokens and the handshake on the ROUTER socket, and whether everyone is still there.
//
//   WAITING  --begin()-->  RUNNING  --finish()-->  ENDING
//
// While WAITING a participant that goes frees its role for another. While RUNNING the loss of the rigid
// process or the recorder throws Stop; while ENDING only that of the recorder, whose acknowledgements are
// waited for.
class Session {
 public:
  enum class State { WAITING, RUNNING, ENDING };
  struct Needs {
    bool rigid = false;
    bool recorder = false;
  };
  // The Welcome for a role, without run id and token.
  using Greeting = std::function<protocol::Message(Role)>;
  // A message of a participant in good standing; its Hello when it has just joined.
  struct Inbound {
    Role role;
    protocol::Message message;
  };

  // A run that goes on has its `run_id`; a new one gets one.
  Session(zmq::socket_t& router, Needs needs, Greeting greeting, const std::string& run_id = {});

  void begin() { state_ = State::RUNNING; }
  void finish() { state_ = State::ENDING; }

  [[nodiscard]] const std::string& run_id() const { return run_id_; }
  [[nodiscard]] bool present(Role role) const { return holder(role) != peers_.end(); }
  // Everyone the run needs has joined.
  [[nodiscard]] bool complete() const;

  // Takes in one message, if one is waiting; false when none was. Handshakes, heartbeats and messages that
  // are refused are dealt with inside; what concerns the run goes to `handle`.
  bool serve(const std::function<void(const Inbound&)>& handle);

  // Sends to the participant in a role; one that cannot be reached is lost.
  void send(Role role, protocol::Message message);
  void refuse(Role role, const Refused& refused);

  // Sends everyone a heartbeat when the last ones are older than `interval`; who cannot be reached twice is
  // lost.
  void heartbeat(std::chrono::milliseconds interval);

 private:
  struct Peer {
    Role role;
    std::uint64_t token;
    std::string program;
    std::string last_refusal;
    bool unreachable = false;  // at the last heartbeat
  };
  using Peers = std::map<std::string, Peer>;  // by the ROUTER's identity of the connection

  [[nodiscard]] Peers::const_iterator holder(Role role) const;
  std::optional<Inbound> admit(protocol::Received received);
  std::optional<Inbound> greet(const std::string& identity, protocol::Message hello);
  void check_role(const std::string& identity, Role role);
  bool deliver(const std::string& identity, protocol::Message& message);
  void refuse(const std::string& identity, const Refused& refused);
  void lose(const std::string& identity);
  void complain(const std::string& text);

  zmq::socket_t& router_;
  Needs needs_;
  Greeting greeting_;
  State state_ = State::WAITING;
  std::string run_id_;
  Peers peers_;
  std::chrono::steady_clock::time_point last_heartbeat_;
  int complaints_ = 0;
};

}  // namespace sluice::server
