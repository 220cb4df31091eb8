#pragma once

#include <optional>
#include <span>
#include <vector>

#include "protocol/message.hpp"
#include "server/kinematics_rows.hpp"

namespace sluice::server {

// Collects the exchanges of contiguous steps into messages for the recorder.
class ExchangeLogger {
 public:
  static constexpr std::uint64_t kMostSteps = 256;  // in one message

  explicit ExchangeLogger(std::size_t bodies) : bodies_(bodies) {}

  void add(std::uint64_t step, std::span<const double> kinematics, std::span<const fluid::Wrench> wrenches);
  [[nodiscard]] bool full() const { return count_ >= kMostSteps; }
  // What was collected since the last call, if anything.
  std::optional<protocol::Message> take();

 private:
  std::size_t bodies_;
  std::uint64_t first_step_ = 0;
  std::uint64_t count_ = 0;
  std::vector<double> kinematics_, wrenches_;
};

}  // namespace sluice::server
