#pragma once

#include <chrono>
#include <optional>
#include <span>
#include <string>
#include <zmq.hpp>

#include "protocol/curve.hpp"
#include "protocol/endpoint.hpp"
#include "protocol/message.hpp"

namespace sluice::clients {

// Waits until one of the sockets has something, at most `timeout`. A signal ends the wait.
void wait_for_any(std::span<zmq::pollitem_t> items, std::chrono::milliseconds timeout);

// A client's side of the exchange with a server, for loops that wait on several sockets: handshake,
// identification of every message, and the watch over the server.
class Connection {
 public:
  Connection(zmq::context_t& context, const protocol::Endpoint& endpoint,
             const std::optional<protocol::ClientKeys>& keys);
  ~Connection();
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  // Says Hello, as a RIGID for the bodies of an owner; the answer comes by receive().
  void greet(Role role, const std::string& program, const std::string& owner = {});
  // Sends with version, run, token and the next sequence filled in. Throws PeerLost.
  void send(protocol::Message message);
  // The next message that is not a heartbeat, if one is waiting; a Welcome is taken note of. Throws
  // ProtocolError with the server's reason when it refuses.
  std::optional<protocol::Message> receive();

  // Sends a heartbeat when one is due. Throws PeerLost when the server has closed the connection or has been
  // silent for 10 s, or for `patience` before its Welcome. Call it after receive() has given nothing.
  void watch(std::chrono::milliseconds patience = std::chrono::seconds(30));
  // A message of the server came another way.
  void hear() { heard_ = Clock::now(); }

  [[nodiscard]] zmq::pollitem_t poll_item() { return {socket_.handle(), 0, ZMQ_POLLIN, 0}; }
  [[nodiscard]] bool welcomed() const { return welcomed_; }
  [[nodiscard]] const std::string& run_id() const { return run_id_; }

 private:
  using Clock = std::chrono::steady_clock;
  void read_monitor();

  std::string endpoint_;
  zmq::socket_t socket_, monitor_;
  std::string run_id_, handshake_failure_;
  std::uint64_t token_ = 0, sequence_ = 0;
  bool welcomed_ = false, disconnected_ = false;
  Clock::time_point heard_ = Clock::now(), beat_ = Clock::now();
};

}  // namespace sluice::clients
