#include "server/exchange_logger.hpp"

#include <cassert>

namespace sluice::server {

namespace {

void move_to(std::vector<double>& to, std::vector<double>& from) {
  to.insert(to.end(), from.begin(), from.end());
  from.clear();
}

}  // namespace

void ExchangeLogger::add(std::uint64_t step, std::span<const double> kinematics,
                         std::span<const fluid::Wrench> wrenches, std::span<const fluid::WrenchParts> parts,
                         std::span<const double> ledger, std::span<const double> indicators) {
  if (rows_.count + pending_.count == 0) first_step_ = step;
  assert(step == first_step_ + rows_.count + pending_.count);
  pending_.kinematics.insert(pending_.kinematics.end(), kinematics.begin(), kinematics.end());
  for (const fluid::Wrench& wrench : wrenches) append(pending_.wrenches, wrench);
  for (const fluid::WrenchParts& part : parts) {
    append(pending_.parts, part.viscous);
    append(pending_.parts, part.guard);
  }
  pending_.ledger.insert(pending_.ledger.end(), ledger.begin(), ledger.end());
  pending_.indicators.insert(pending_.indicators.end(), indicators.begin(), indicators.end());
  ++pending_.count;
}

void ExchangeLogger::accept(std::uint32_t iterations, double residual) {
  for (std::uint64_t k = 0; k < pending_.count; ++k)
    coupling_.insert(coupling_.end(), {static_cast<double>(iterations), residual});
  move_to(rows_.kinematics, pending_.kinematics);
  move_to(rows_.wrenches, pending_.wrenches);
  move_to(rows_.parts, pending_.parts);
  move_to(rows_.ledger, pending_.ledger);
  move_to(rows_.indicators, pending_.indicators);
  rows_.count += pending_.count;
  pending_.count = 0;
}

void ExchangeLogger::drop() {
  pending_ = {};
}

std::optional<protocol::Message> ExchangeLogger::take() {
  if (rows_.count == 0) return std::nullopt;
  protocol::Message message;
  message.header.set_step(first_step_ + rows_.count - 1);
  message.header.mutable_exchange_log()->set_first_step(first_step_);
  message.header.mutable_exchange_log()->set_count(static_cast<std::uint32_t>(rows_.count));
  message.add_array<double>("kinematics", rows_.kinematics, {rows_.count, bodies_, kKinematicsRow});
  message.add_array<double>("wrenches", rows_.wrenches, {rows_.count, bodies_, kWrenchRow});
  message.add_array<double>("coupling", coupling_, {rows_.count, 2});
  message.add_array<double>("wrench_parts", rows_.parts, {rows_.count, bodies_, 2 * kWrenchRow});
  message.add_array<double>("ledger", rows_.ledger, {rows_.count, bodies_, kLedgerRow});
  message.add_array<double>("indicator", rows_.indicators, {rows_.count, bodies_});
  rows_ = {};
  coupling_.clear();
  return message;
}

}  // namespace sluice::server
