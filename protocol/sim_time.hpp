#pragma once

#include <cstdint>

namespace sluice::protocol {

using Nanoseconds = std::int64_t;

[[nodiscard]] constexpr double seconds(Nanoseconds t) {
  return 1e-9 * static_cast<double>(t);
}

// When each fluid step ends. Output times are hit exactly: an interval between two outputs is divided
// into equal steps, rounded to whole nanoseconds, so that every process computes the same instants.
class StepClock {
 public:
  StepClock(Nanoseconds interval, std::uint64_t steps_per_interval, std::uint64_t steps);

  // Largest steps not above `largest_step` [s] for a run of `duration` [s] with `rate` outputs a second.
  // Throws std::invalid_argument where a step would be shorter than 1000 ns.
  static StepClock for_run(double duration, double rate, double largest_step);

  [[nodiscard]] Nanoseconds time(std::uint64_t step) const;      // end of step; time(0) = 0
  [[nodiscard]] Nanoseconds duration(std::uint64_t step) const;  // time(step) - time(step - 1), step >= 1
  [[nodiscard]] bool is_output(std::uint64_t step) const { return step % steps_per_interval_ == 0; }

  // The last step of an exchange of up to `count` steps from `first` on; it does not go beyond an output.
  [[nodiscard]] std::uint64_t exchange_end(std::uint64_t first, std::uint64_t count) const;

  [[nodiscard]] Nanoseconds interval() const { return interval_; }
  [[nodiscard]] std::uint64_t steps_per_interval() const { return steps_per_interval_; }
  [[nodiscard]] std::uint64_t steps() const { return steps_; }

 private:
  Nanoseconds interval_;
  std::uint64_t steps_per_interval_;
  std::uint64_t steps_;
};

}  // namespace sluice::protocol
