#pragma once

#include <string>

#include "protocol/endpoint.hpp"
#include "protocol/framing.hpp"

namespace sluice::clients::test {

// The server's side of a conversation, played by hand from a test's thread.
class FakeServer {
 public:
  explicit FakeServer(const std::string& endpoint);

  // The next message of the client that is not a heartbeat; those are answered.
  protocol::Message receive();
  // To the client that spoke last.
  void reply(protocol::Message message);
  // Over the stream to the recorder, under the next sequence.
  void push(protocol::Message message);
  // Waits for acknowledgements until this one has come.
  void await_acknowledgement(std::uint64_t sequence);
  // Gone from the network, as after a kill.
  void vanish();

  [[nodiscard]] std::uint64_t pushed() const { return pushed_; }

 private:
  zmq::context_t context_;
  zmq::socket_t exchange_, record_;
  std::string client_;
  std::uint64_t pushed_ = 0;
};

}  // namespace sluice::clients::test
