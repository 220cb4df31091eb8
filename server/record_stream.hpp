#pragma once

#include <cstdint>
#include <deque>

#include "protocol/framing.hpp"

namespace sluice::server {

// Of the header and the arrays.
std::size_t bytes_of(const protocol::Message& message);

// The lossless stream to the recorder: at most kMostMessages or about kMostBytes are sent and not
// acknowledged; then the run has to wait. Nothing is ever dropped.
class RecordStream {
 public:
  static constexpr std::size_t kMostMessages = 64;
  static constexpr std::size_t kMostBytes = std::size_t{256} << 20;

  explicit RecordStream(zmq::socket_t& push) : push_(push) {}

  [[nodiscard]] bool has_room() const;
  // Sends the message under the next sequence; false while no recorder is connected. Precondition:
  // has_room().
  bool offer(protocol::Message& message);

  // Everything up to `sequence` is on disk. Throws Refused for one that was not sent.
  void acknowledge(std::uint64_t sequence);
  [[nodiscard]] std::uint64_t sent() const { return last_sequence_; }
  [[nodiscard]] std::uint64_t acknowledged() const { return last_sequence_ - in_flight_.size(); }
  // The step of the last message acknowledged.
  [[nodiscard]] std::uint64_t acknowledged_step() const { return acknowledged_step_; }

 private:
  struct Sent {
    std::size_t bytes;
    std::uint64_t step;
  };

  zmq::socket_t& push_;
  std::uint64_t last_sequence_ = 0;
  std::uint64_t acknowledged_step_ = 0;
  std::deque<Sent> in_flight_;  // not acknowledged, oldest first
  std::size_t bytes_ = 0;       // of them
};

}  // namespace sluice::server
