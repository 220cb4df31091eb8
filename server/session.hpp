#pragma once

#include <chrono>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

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
  // Of a participant: its role, and of a RIGID the owner whose bodies it moves (Body.owner).
  struct Seat {
    Seat(Role its_role, std::string its_owner = {}) : role(its_role), owner(std::move(its_owner)) {}
    bool operator==(const Seat&) const = default;
    Role role;
    std::string owner;
  };
  struct Needs {
    std::vector<std::string> owners;
    bool recorder = false;
  };
  // The Welcome for a seat, without run id and token.
  using Greeting = std::function<protocol::Message(const Seat&)>;
  // A message of a participant in good standing; its Hello when it has just joined.
  struct Inbound {
    Seat seat;
    protocol::Message message;
  };

  // A run that goes on has its `run_id`; a new one gets one.
  Session(zmq::socket_t& router, Needs needs, Greeting greeting, const std::string& run_id = {});

  void begin() { state_ = State::RUNNING; }
  void finish() { state_ = State::ENDING; }

  [[nodiscard]] const std::string& run_id() const { return run_id_; }
  [[nodiscard]] bool present(const Seat& seat) const { return holder(seat) != peers_.end(); }
  // Everyone the run needs has joined.
  [[nodiscard]] bool complete() const;

  // Takes in one message, if one is waiting; false when none was. Handshakes, heartbeats and messages that
  // are refused are dealt with inside; what concerns the run goes to `handle`.
  bool serve(const std::function<void(const Inbound&)>& handle);

  // Sends to the participant on a seat; one that cannot be reached is lost.
  void send(const Seat& seat, protocol::Message message);
  void refuse(const Seat& seat, const Refused& refused);

  // Sends everyone a heartbeat when the last ones are older than `interval`; who cannot be reached twice is
  // lost.
  void heartbeat(std::chrono::milliseconds interval);

 private:
  struct Peer {
    Seat seat;
    std::uint64_t token;
    std::string program;
    std::string last_refusal;
    bool unreachable = false;  // at the last heartbeat
  };
  using Peers = std::map<std::string, Peer>;  // by the ROUTER's identity of the connection

  [[nodiscard]] Peers::const_iterator holder(const Seat& seat) const;
  std::optional<Inbound> admit(protocol::Received received);
  std::optional<Inbound> greet(const std::string& identity, protocol::Message hello);
  void check_seat(const std::string& identity, const Seat& seat);
  void check_need(const Seat& seat) const;
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

// Names who sits there in messages to people.
std::string name_of(const Session::Seat& seat);

}  // namespace sluice::server
