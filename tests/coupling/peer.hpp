#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <optional>
#include <stdexcept>
#include <string>

#include "protocol/endpoint.hpp"
#include "protocol/framing.hpp"
#include "protocol/version.hpp"
#include "server/kinematics_rows.hpp"

namespace sluice::testing {

constexpr int kPatience = 20000;  // [ms] before a test that waits for a message fails

// A participant or watcher as the server sees one.
class Peer {
 public:
  explicit Peer(const protocol::Endpoint& endpoint) { exchange_.connect(endpoint.exchange); }

  // Says Hello and keeps what a Welcome gives. Returns the answer.
  protocol::Message hello(Role role, bool gives_state = false, bool probes = false,
                          const std::string& owner = {}) {
    protocol::Message hello;
    hello.header.mutable_hello()->set_role(role);
    hello.header.mutable_hello()->set_gives_state(gives_state);
    hello.header.mutable_hello()->set_program("test");
    hello.header.mutable_hello()->set_probes(probes);
    hello.header.mutable_hello()->set_owner(owner);
    send_raw(hello);
    protocol::Message answer = receive();
    if (answer.header.has_welcome()) {
      run_id_ = answer.header.run_id();
      token_ = answer.header.session_token();
    }
    return answer;
  }

  void send(protocol::Message& message) {
    message.header.set_run_id(run_id_);
    message.header.set_session_token(token_);
    send_raw(message);
  }

  // As it is, but for the version when none is set.
  void send_raw(protocol::Message& message) {
    if (message.header.protocol_version() == 0)
      message.header.set_protocol_version(protocol::kProtocolVersion);
    if (!protocol::send(exchange_, message)) throw std::runtime_error("the test's message was not sent");
  }

  // The next message that is no heartbeat; throws when none comes.
  protocol::Message receive() {
    while (auto received = protocol::receive_within(exchange_, kPatience)) {
      if (!received->message.header.has_heartbeat()) return std::move(received->message);
    }
    throw std::runtime_error("no message came");
  }

  // Whether anything but heartbeats comes within the time.
  bool hears_within(int milliseconds) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::milliseconds(milliseconds);
    for (auto left = milliseconds; left >= 0;) {
      const auto received = protocol::receive_within(exchange_, left);
      if (received && !received->message.header.has_heartbeat()) return true;
      const auto rest = end - std::chrono::steady_clock::now();
      left = static_cast<int>(std::chrono::floor<std::chrono::milliseconds>(rest).count());
    }
    return false;
  }

  [[nodiscard]] std::uint64_t token() const { return token_; }
  void set_token(std::uint64_t token) { token_ = token; }
  void set_run_id(const std::string& run_id) { run_id_ = run_id; }
  zmq::context_t& context() { return context_; }
  zmq::socket_t& socket() { return exchange_; }

 private:
  zmq::context_t context_;
  zmq::socket_t exchange_ = protocol::make_socket(context_, zmq::socket_type::dealer);
  std::string run_id_;
  std::uint64_t token_ = 0;
};

// Kinematics of steps first .. first + count - 1; body b at step n stands at (n, b, 0).
inline protocol::Message kinematics(std::uint64_t sequence, std::uint64_t first, std::uint32_t count,
                                    std::size_t bodies = 1) {
  std::vector<double> rows;
  for (std::uint64_t step = first; step < first + count; ++step) {
    for (std::size_t b = 0; b < bodies; ++b) {
      fluid::Kinematics k;
      k.position = {static_cast<double>(step), static_cast<double>(b), 0};
      server::append(rows, k);
    }
  }
  protocol::Message message;
  message.header.set_sequence(sequence);
  message.header.mutable_kinematics()->set_first_step(first);
  message.header.mutable_kinematics()->set_count(count);
  message.add_array<double>("kinematics", rows, {count, bodies, server::kKinematicsRow});
  return message;
}

// Plays a rigid process until the server says End: `count` steps a message, `ahead` messages unanswered.
// Returns every wrench row it was answered.
inline std::vector<double> play_rigid(Peer& peer, std::uint64_t steps, std::uint32_t count,
                                      std::uint64_t ahead) {
  std::vector<double> wrenches;
  std::uint64_t sent = 0, sequence = 0, unanswered = 0;
  while (true) {
    while (sent < steps && unanswered < ahead) {
      const auto size = static_cast<std::uint32_t>(std::min<std::uint64_t>(count, steps - sent));
      protocol::Message message = kinematics(++sequence, sent + 1, size);
      peer.send(message);
      sent += size;
      ++unanswered;
    }
    const protocol::Message answer = peer.receive();
    if (answer.header.has_end()) return wrenches;
    if (!answer.header.has_wrenches())
      throw std::runtime_error("refused: " + answer.header.refusal().reason());
    const auto rows = answer.array<double>("wrenches");
    wrenches.insert(wrenches.end(), rows.begin(), rows.end());
    --unanswered;
  }
}

// A recorder that keeps what it is sent.
class TestRecorder {
 public:
  explicit TestRecorder(const protocol::Endpoint& endpoint) : peer_(endpoint) {
    welcome_ = peer_.hello(RECORDER);
    if (welcome_.header.has_welcome()) pull_.connect(welcome_.header.welcome().record_endpoint());
  }

  // The next message of the stream, if one comes in time.
  std::optional<protocol::Message> pull(int milliseconds = kPatience) {
    auto received = protocol::receive_within(pull_, milliseconds);
    if (!received) return std::nullopt;
    return std::move(received->message);
  }

  void acknowledge(std::uint64_t sequence) {
    protocol::Message message;
    message.header.mutable_acknowledgement()->set_sequence(sequence);
    peer_.send(message);
  }

  // Acknowledges everything until End; all messages in order.
  std::vector<protocol::Message> record() {
    std::vector<protocol::Message> messages;
    while (auto message = pull()) {
      acknowledge(message->header.sequence());
      const bool last = message->header.has_end();
      messages.push_back(std::move(*message));
      if (last) return messages;
    }
    throw std::runtime_error("the stream stopped without End");
  }

  [[nodiscard]] const protocol::Message& welcome() const { return welcome_; }
  Peer& peer() { return peer_; }

 private:
  Peer peer_;
  zmq::socket_t pull_ = protocol::make_socket(peer_.context(), zmq::socket_type::pull);
  protocol::Message welcome_;
};

}  // namespace sluice::testing
