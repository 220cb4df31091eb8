#include "server/exchange_logger.hpp"

#include <cassert>

namespace sluice::server {

void ExchangeLogger::add(std::uint64_t step, std::span<const double> kinematics,
                         std::span<const fluid::Wrench> wrenches) {
  if (count_ == 0) first_step_ = step;
  assert(step == first_step_ + count_);
  kinematics_.insert(kinematics_.end(), kinematics.begin(), kinematics.end());
  for (const fluid::Wrench& wrench : wrenches) append(wrenches_, wrench);
  ++count_;
}

std::optional<protocol::Message> ExchangeLogger::take() {
  if (count_ == 0) return std::nullopt;
  protocol::Message message;
  message.header.set_step(first_step_ + count_ - 1);
  message.header.mutable_exchange_log()->set_first_step(first_step_);
  message.header.mutable_exchange_log()->set_count(static_cast<std::uint32_t>(count_));
  message.add_array<double>("kinematics", kinematics_, {count_, bodies_, kKinematicsRow});
  message.add_array<double>("wrenches", wrenches_, {count_, bodies_, kWrenchRow});
  kinematics_.clear();
  wrenches_.clear();
  count_ = 0;
  return message;
}

}  // namespace sluice::server
