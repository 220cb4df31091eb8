#include "server/record_stream.hpp"

#include <fmt/format.h>

#include <cassert>

#include "server/stop.hpp"

namespace sluice::server {

std::size_t bytes_of(const protocol::Message& message) {
  std::size_t bytes = message.header.ByteSizeLong();
  for (const zmq::message_t& raw : message.frames) bytes += raw.size();
  return bytes;
}

bool RecordStream::has_room() const {
  return in_flight_.size() < kMostMessages && bytes_ < kMostBytes;
}

bool RecordStream::offer(protocol::Message& message) {
  assert(has_room());
  message.header.set_sequence(last_sequence_ + 1);
  if (!protocol::send(push_, message)) return false;
  ++last_sequence_;
  const std::size_t bytes = bytes_of(message);
  in_flight_.push_back({bytes, message.header.step()});
  bytes_ += bytes;
  return true;
}

void RecordStream::acknowledge(std::uint64_t sequence) {
  if (sequence > last_sequence_) {
    throw Refused(Refusal::BAD_SEQUENCE,
                  fmt::format("acknowledged {}, but only {} messages were sent", sequence, last_sequence_));
  }
  while (acknowledged() < sequence) {
    bytes_ -= in_flight_.front().bytes;
    acknowledged_step_ = in_flight_.front().step;
    in_flight_.pop_front();
  }
}

}  // namespace sluice::server
