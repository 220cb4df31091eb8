#include "protocol/sim_time.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>

namespace sluice::protocol {
namespace {

__extension__ using Wide = __int128;  // for products of times and counts

constexpr Nanoseconds kShortestStep = 1000;
constexpr double kLongestRun = 1e9;  // [s], so that all instants fit into 63 bits

// Whole nanoseconds not above `t` [s], also after the conversion back.
Nanoseconds floor_nanoseconds(double t) {
  auto result = static_cast<Nanoseconds>(std::floor(1e9 * t));
  while (result > 0 && seconds(result) > t) --result;
  return result;
}

void require_positive(double value, const char* name) {
  if (!std::isfinite(value) || value <= 0 || value > kLongestRun)
    throw std::invalid_argument(fmt::format("{} {} is not between 0 and {}", name, value, kLongestRun));
}

Nanoseconds ceil_divide(Nanoseconds a, Nanoseconds b) {
  return (a + b - 1) / b;
}

// Steps of the whole run. Rounding the interval to nanoseconds must not
// leave a run of n intervals a sliver short of, or past, its last output.
std::uint64_t count_steps(Nanoseconds duration, Nanoseconds interval, Nanoseconds steps_per_interval) {
  const Nanoseconds intervals = (duration + interval / 2) / interval;
  if (std::abs(intervals * interval - duration) <= intervals)
    return static_cast<std::uint64_t>(intervals * steps_per_interval);
  const Nanoseconds rest = ceil_divide(Wide{duration % interval} * steps_per_interval, interval);
  return static_cast<std::uint64_t>(duration / interval * steps_per_interval + rest);
}

}  // namespace

StepClock::StepClock(Nanoseconds interval, std::uint64_t steps_per_interval, std::uint64_t steps)
    : interval_(interval), steps_per_interval_(steps_per_interval), steps_(steps) {
  if (interval < 1 || steps_per_interval < 1 || steps_per_interval > static_cast<std::uint64_t>(interval))
    throw std::invalid_argument(fmt::format("{} steps in an interval of {} ns: each needs at least 1 ns",
                                            steps_per_interval, interval));
  const auto most = static_cast<std::uint64_t>(std::numeric_limits<Nanoseconds>::max() / interval);
  if (steps / steps_per_interval >= most)
    throw std::invalid_argument(
        fmt::format("{} steps, {} in an interval of {} ns: the time does not fit into 63 bits", steps,
                    steps_per_interval, interval));
}

StepClock StepClock::for_run(double duration, double rate, double largest_step) {
  require_positive(duration, "duration [s]");
  require_positive(rate, "output rate [1/s]");
  require_positive(largest_step, "time step [s]");
  require_positive(1 / rate, "output interval [s]");
  const Nanoseconds interval = std::llround(1e9 / rate);
  const Nanoseconds largest = floor_nanoseconds(largest_step);
  const Nanoseconds per_interval = largest > 0 ? ceil_divide(interval, largest) : interval + 1;
  if (interval / per_interval < kShortestStep)
    throw std::invalid_argument(fmt::format(
        "a time step of {} s with {} outputs a second is shorter than {} ns; use a larger spacing, "
        "a smaller speed of sound or fewer outputs",
        largest_step, rate, kShortestStep));
  return {interval, static_cast<std::uint64_t>(per_interval),
          count_steps(std::llround(1e9 * duration), interval, per_interval)};
}

Nanoseconds StepClock::time(std::uint64_t step) const {
  const auto per_interval = static_cast<Nanoseconds>(steps_per_interval_);
  const auto whole = static_cast<Nanoseconds>(step / steps_per_interval_);
  const auto part = static_cast<Nanoseconds>(step % steps_per_interval_);
  return whole * interval_ + static_cast<Nanoseconds>(Wide{part} * interval_ / per_interval);
}

std::uint64_t StepClock::exchange_end(std::uint64_t first, std::uint64_t count) const {
  const std::uint64_t next_output = ((first - 1) / steps_per_interval_ + 1) * steps_per_interval_;
  return std::min({first + count - 1, next_output, steps_});
}

Nanoseconds StepClock::duration(std::uint64_t step) const {
  return time(step) - time(step - 1);
}

}  // namespace sluice::protocol
