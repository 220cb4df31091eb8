#include "server/exchange.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "server/probes.hpp"
#include "server/stop.hpp"

namespace sluice::server {

using protocol::Message;

namespace {

constexpr double kUnitLength = 1e-6;  // allowed deviation of a quaternion's length

std::string shape_text(const std::vector<std::uint64_t>& shape) {
  return fmt::format("[{}]", fmt::join(shape, ", "));
}

}  // namespace

Exchange::Exchange(std::size_t bodies, std::uint64_t steps, const Terms& terms)
    : bodies_(bodies), steps_(steps), terms_(terms), last_step_(terms.done) {}

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
  batches_.push_back({sequence,
                      content.first_step(),
                      content.count(),
                      content.iteration(),
                      {rows.begin(), rows.end()},
                      read_ledger(message),
                      {}});
  last_sequence_ = sequence;
  last_step_ = content.first_step() + content.count() - 1;
  return std::nullopt;
}

void Exchange::check(const Message& message) const {
  const std::uint64_t sequence = message.header.sequence();
  if (sequence != last_sequence_ + 1) {
    throw Refused(Refusal::BAD_SEQUENCE,
                  fmt::format("sequence {} came, expected {}", sequence, last_sequence_ + 1));
  }
  const Kinematics& content = message.header.kinematics();
  check_turn(content);
  if (batches_.size() >= kMostUnanswered) {
    throw Refused(Refusal::BAD_MESSAGE,
                  fmt::format("{} messages wait for their answer; wait for one before sending "
                              "sequence {}",
                              batches_.size(), sequence));
  }
  const std::uint64_t most = most_steps(content);
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

// Whether it is the turn of these steps.
void Exchange::check_turn(const Kinematics& content) const {
  if (content.iteration() > 0) {
    if (open_ && content.first_step() == open_->first_step && content.count() == open_->count &&
        content.iteration() == open_->iteration + 1)
      return;
    throw Refused(Refusal::BAD_SEQUENCE,
                  fmt::format("iteration {} of {} steps from step {} came; {}", content.iteration(),
                              content.count(), content.first_step(),
                              open_ ? fmt::format("expected iteration {} of {} steps from step {}",
                                                  open_->iteration + 1, open_->count, open_->first_step)
                                    : "no exchange is open"));
  }
  if (content.first_step() != last_step_ + 1)
    throw Refused(Refusal::BAD_SEQUENCE, fmt::format("kinematics of step {} came, expected step {}",
                                                     content.first_step(), last_step_ + 1));
  if (open_)
    throw Refused(Refusal::BAD_SEQUENCE,
                  fmt::format("kinematics of step {} came before the exchange from step {} was accepted",
                              content.first_step(), open_->first_step));
}

std::uint64_t Exchange::most_steps(const Kinematics& content) const {
  const std::uint64_t first = content.first_step(), left = steps_ - first + 1;
  if (!terms_.lock_step) return std::min<std::uint64_t>(kMostSteps, left);
  const std::uint64_t to_output = terms_.steps_per_output - (first - 1) % terms_.steps_per_output;
  return std::min({terms_.steps_per_exchange, to_output, left});
}

void Exchange::accept_exchange(const Accepted& accepted) {
  if (!open_ || accepted.first_step() != open_->first_step || accepted.count() != open_->count)
    throw Refused(
        Refusal::BAD_SEQUENCE,
        fmt::format("{} steps from step {} were accepted; {}", accepted.count(), accepted.first_step(),
                    open_ ? fmt::format("{} from step {} wait for it", open_->count, open_->first_step)
                          : "none wait for it"));
  if (!std::isfinite(accepted.residual()))
    throw Refused(Refusal::BAD_MESSAGE,
                  fmt::format("a residual of {}; it must be finite", accepted.residual()));
  accepted_ = accepted;
  open_.reset();
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

std::vector<double> Exchange::read_ledger(const Message& message) const {
  std::vector<double> ledger(bodies_ * kLedgerRow, 0.0);
  const auto& arrays = message.header.array();
  const bool present =
      std::any_of(arrays.begin(), arrays.end(), [](const Array& a) { return a.name() == "ledger"; });
  if (!present) return ledger;
  try {
    const std::span<const double> given = message.array<double>("ledger");
    if (given.size() != ledger.size() ||
        !std::all_of(given.begin(), given.end(), [](double x) { return std::isfinite(x); }))
      throw Refused(Refusal::BAD_MESSAGE,
                    fmt::format("array ledger has {} values; {} finite ones are allowed, {} a body",
                                given.size(), ledger.size(), kLedgerRow));
    ledger.assign(given.begin(), given.end());
  } catch (const protocol::ProtocolError& error) {
    throw Refused(Refusal::BAD_MESSAGE, error.what());
  }
  return ledger;
}

std::span<const double> Exchange::ledger() const {
  assert(!batches_.empty());
  return batches_.front().ledger;
}

std::uint64_t Exchange::last_step() const {
  assert(!batches_.empty());
  return batches_.front().first_step + batches_.front().count - 1;
}

std::span<const double> Exchange::rows(std::uint64_t step) const {
  assert(has(step));
  const Batch& batch = batches_.front();
  const std::size_t size = bodies_ * kKinematicsRow;
  return std::span<const double>(batch.kinematics).subspan((step - batch.first_step) * size, size);
}

std::optional<Message> Exchange::answer(std::uint64_t step, std::span<const fluid::Wrench> wrenches,
                                        std::span<const double> probes) {
  assert(has(step) && wrenches.size() == bodies_);
  Batch& batch = batches_.front();
  for (const fluid::Wrench& wrench : wrenches) append(batch.wrenches, wrench);
  if (step + 1 < batch.first_step + batch.count) return std::nullopt;

  replies_.push_back(reply(batch, probes));
  if (terms_.is_iterated) open_ = {batch.first_step, batch.count, batch.iteration};
  if (replies_.size() > kMostUnanswered) replies_.pop_front();
  batches_.pop_front();
  return replies_.back().clone();
}

Message Exchange::reply(const Batch& batch, std::span<const double> probes) const {
  Message message;
  message.header.set_sequence(batch.sequence);
  message.header.set_step(batch.first_step + batch.count - 1);
  message.header.mutable_wrenches()->set_first_step(batch.first_step);
  message.header.mutable_wrenches()->set_count(static_cast<std::uint32_t>(batch.count));
  message.add_array<double>("wrenches", batch.wrenches, {batch.count, bodies_, kWrenchRow});
  if (!probes.empty()) message.add_array<double>("probe", probes, {probes.size() / kProbeRow, kProbeRow});
  return message;
}

}  // namespace sluice::server
