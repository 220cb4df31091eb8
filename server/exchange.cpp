#include "server/exchange.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "server/stop.hpp"

namespace sluice::server {

using protocol::Message;

namespace {

constexpr double kUnitLength = 1e-6;  // allowed deviation of a quaternion's length

std::string shape_text(const std::vector<std::uint64_t>& shape) {
  return fmt::format("[{}]", fmt::join(shape, ", "));
}

}  // namespace

Exchange::Exchange(std::size_t bodies, std::uint64_t steps, bool lock_step)
    : bodies_(bodies), steps_(steps), lock_step_(lock_step) {}

std::optional<Message> Exchange::accept(const Message& message) {
  const std::uint64_t sequence = message.header.sequence();
  for (const Message& reply : replies_) {
    if (reply.header.sequence() == sequence) return reply.clone();
  }
  for (const Batch& batch : batches_) {
    if (batch.sequence == sequence) return std::nullopt;
  }
  check(message);
  const Kinematics& content = message.header.kinematics();
  const std::span<const double> rows = message.array<double>("kinematics");
  batches_.push_back({sequence, content.first_step(), content.count(), {rows.begin(), rows.end()}, {}});
  last_sequence_ = sequence;
  last_step_ += content.count();
  return std::nullopt;
}

void Exchange::check(const Message& message) const {
  const std::uint64_t sequence = message.header.sequence();
  if (sequence != last_sequence_ + 1) {
    throw Refused(Refusal::BAD_SEQUENCE,
                  fmt::format("sequence {} came, expected {}", sequence, last_sequence_ + 1));
  }
  const Kinematics& content = message.header.kinematics();
  if (content.first_step() != last_step_ + 1) {
    throw Refused(Refusal::BAD_SEQUENCE, fmt::format("kinematics of step {} came, expected step {}",
                                                     content.first_step(), last_step_ + 1));
  }
  if (batches_.size() >= kMostUnanswered) {
    throw Refused(Refusal::BAD_MESSAGE,
                  fmt::format("{} messages wait for their answer; wait for one before sending "
                              "sequence {}",
                              batches_.size(), sequence));
  }
  const std::uint64_t most = std::min<std::uint64_t>(lock_step_ ? 1 : kMostSteps, steps_ - last_step_);
  if (content.count() < 1 || content.count() > most) {
    throw Refused(Refusal::BAD_MESSAGE,
                  fmt::format("kinematics of {} steps from step {}; allowed are 1 to {}", content.count(),
                              content.first_step(), most));
  }
  const std::vector<std::uint64_t> expected{content.count(), bodies_, kKinematicsRow};
  try {
    const std::vector<std::uint64_t> shape = message.shape("kinematics");
    if (shape != expected) {
      throw Refused(Refusal::BAD_MESSAGE, fmt::format("array kinematics has the shape {}, expected {}",
                                                      shape_text(shape), shape_text(expected)));
    }
    check_rows(message.array<double>("kinematics"), content.first_step());
  } catch (const protocol::ProtocolError& error) {
    throw Refused(Refusal::BAD_MESSAGE, error.what());
  }
}

void Exchange::check_rows(std::span<const double> rows, std::uint64_t first_step) const {
  for (std::size_t r = 0; r < rows.size() / kKinematicsRow; ++r) {
    const std::span<const double> row = rows.subspan(r * kKinematicsRow, kKinematicsRow);
    const auto where = [&] {
      return fmt::format("body {} at step {}", r % bodies_, first_step + r / bodies_);
    };
    for (std::size_t c = 0; c < row.size(); ++c) {
      if (std::isfinite(row[c])) continue;
      throw Refused(
          Refusal::BAD_MESSAGE,
          fmt::format("kinematics of {}: entry {} is {}; finite numbers are allowed", where(), c, row[c]));
    }
    const double length = std::sqrt(row[3] * row[3] + row[4] * row[4] + row[5] * row[5] + row[6] * row[6]);
    if (std::abs(length - 1) > kUnitLength) {
      throw Refused(
          Refusal::BAD_MESSAGE,
          fmt::format("kinematics of {}: the quaternion's length is {}; it must be 1", where(), length));
    }
  }
}

bool Exchange::has(std::uint64_t step) const {
  if (batches_.empty()) return false;
  const Batch& batch = batches_.front();
  return batch.first_step <= step && step < batch.first_step + batch.count;
}

std::span<const double> Exchange::rows(std::uint64_t step) const {
  assert(has(step));
  const Batch& batch = batches_.front();
  const std::size_t size = bodies_ * kKinematicsRow;
  return std::span<const double>(batch.kinematics).subspan((step - batch.first_step) * size, size);
}

std::span<const fluid::Kinematics> Exchange::kinematics(std::uint64_t step) {
  const std::span<const double> all = rows(step);
  current_.clear();
  for (std::size_t b = 0; b < bodies_; ++b) {
    current_.push_back(read_kinematics(all.subspan(b * kKinematicsRow, kKinematicsRow)));
  }
  return current_;
}

std::optional<Message> Exchange::answer(std::uint64_t step, std::span<const fluid::Wrench> wrenches) {
  assert(has(step) && wrenches.size() == bodies_);
  Batch& batch = batches_.front();
  for (const fluid::Wrench& wrench : wrenches) append(batch.wrenches, wrench);
  if (step + 1 < batch.first_step + batch.count) return std::nullopt;

  replies_.push_back(reply(batch));
  if (replies_.size() > kMostUnanswered) replies_.pop_front();
  batches_.pop_front();
  return replies_.back().clone();
}

Message Exchange::reply(const Batch& batch) const {
  Message message;
  message.header.set_sequence(batch.sequence);
  message.header.set_step(batch.first_step + batch.count - 1);
  message.header.mutable_wrenches()->set_first_step(batch.first_step);
  message.header.mutable_wrenches()->set_count(static_cast<std::uint32_t>(batch.count));
  message.add_array<double>("wrenches", batch.wrenches, {batch.count, bodies_, kWrenchRow});
  return message;
}

}  // namespace sluice::server
