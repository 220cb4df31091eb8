#pragma once

#include "tests/coupling/peer.hpp"
#include "tests/faults/child.hpp"

namespace sluice::testing {

constexpr std::uint64_t kMidRun = 20;  // exchanges or messages after which a child counts as being in mid-run

// A body above the water at rest.
inline protocol::Message pose(std::uint64_t sequence, std::uint64_t first, std::uint32_t count) {
  std::vector<double> rows;
  fluid::Kinematics k;
  k.position = {0.5, 1.2, 0};
  for (std::uint32_t i = 0; i < count; ++i) server::append(rows, k);
  protocol::Message message;
  message.header.set_sequence(sequence);
  message.header.mutable_kinematics()->set_first_step(first);
  message.header.mutable_kinematics()->set_count(count);
  message.add_array<double>("kinematics", rows, {count, 1, server::kKinematicsRow});
  return message;
}

// Plays a rigid process until the server goes: `count` steps a message, `ahead` messages unanswered. Raises
// `mid_run`; when `hang`, it sends heartbeats and nothing else from then on.
inline void rigid_child(const protocol::Endpoint& endpoint, std::uint32_t count, std::uint64_t ahead,
                        const Signal& mid_run, bool hang) {
  Peer peer(endpoint);
  if (!peer.hello(RIGID).header.has_welcome()) throw std::runtime_error("not welcome");
  std::uint64_t sequence = 0, answered = 0;
  while (true) {
    while (sequence - answered < ahead) {
      protocol::Message message = pose(sequence + 1, sequence * count + 1, count);
      peer.send(message);
      ++sequence;
    }
    if (!peer.receive().header.has_wrenches()) return;
    if (++answered == kMidRun) {
      mid_run.raise();
      while (hang) {
        protocol::Message heartbeat;
        heartbeat.header.mutable_heartbeat();
        peer.send(heartbeat);
        if (peer.hears_within(100)) return;
      }
    }
  }
}

// Acknowledges what it gets until the server goes, the first messages only when `hang`.
inline void recorder_child(const protocol::Endpoint& endpoint, const Signal& mid_run, bool hang) {
  TestRecorder recorder(endpoint);
  std::uint64_t received = 0;
  while (const auto message = recorder.pull()) {
    if (++received == kMidRun) mid_run.raise();
    if (!hang || received < kMidRun) recorder.acknowledge(message->header.sequence());
    if (message->header.has_end()) return;
  }
}

}  // namespace sluice::testing
