#pragma once

#include <chrono>
#include <cstdint>

namespace sluice::server {

// Wall clock of a run and its speed.
class Progress {
 public:
  // `steps` were done before.
  explicit Progress(std::uint64_t steps = 0) : steps_(steps) {}

  // Whether the next report is due; true about ten times a second.
  [[nodiscard]] bool due() const { return Clock::now() - reported_ >= std::chrono::milliseconds(100); }
  // Steps a second, averaged over about the last ten reports. Call once for every report.
  double rate(std::uint64_t steps_done);
  [[nodiscard]] double wall_seconds() const { return seconds(Clock::now() - start_); }

 private:
  using Clock = std::chrono::steady_clock;
  static double seconds(Clock::duration d) { return std::chrono::duration<double>(d).count(); }

  Clock::time_point start_ = Clock::now();
  Clock::time_point reported_ = start_;
  std::uint64_t steps_;
  double rate_ = 0;
};

}  // namespace sluice::server
