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

  // A step of an exchange that may still be repeated.
  void add(std::uint64_t step, std::span<const double> kinematics, std::span<const fluid::Wrench> wrenches,
           std::span<const fluid::WrenchParts> parts, std::span<const double> ledger,
           std::span<const double> indicators);
  // The steps added since the last call are those of an exchange: now they count; or never.
  void accept(std::uint32_t iterations, double residual);
  void drop();
  [[nodiscard]] bool full() const { return rows_.count >= kMostSteps; }
  // What was collected since the last call, if anything.
  std::optional<protocol::Message> take();

 private:
  std::size_t bodies_;
  struct Rows {
    std::uint64_t count = 0;
    std::vector<double> kinematics, wrenches, parts, ledger, indicators;
  };

  std::uint64_t first_step_ = 0;
  Rows pending_, rows_;
  std::vector<double> coupling_;
};

}  // namespace sluice::server
