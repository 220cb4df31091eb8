#include "clients/replay/playback.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "protocol/error.hpp"

namespace sluice::clients {
namespace {

[[noreturn]] void refuse(const std::string& line) {
  throw protocol::InputError(fmt::format(
      "'{}' is no command of a replay; pause, play, step [N], seek T, speed X and quit are", line));
}

// The number behind a command. Throws InputError where there is none, or more than that.
double number(std::istringstream& words, const std::string& line) {
  double value = 0;
  std::string rest;
  if (!(words >> value) || words >> rest || !std::isfinite(value)) refuse(line);
  return value;
}

}  // namespace

Playback::Playback(std::vector<std::int64_t> times, double speed, double from, Clock::time_point now)
    : times_(std::move(times)), speed_(speed) {
  set(frame_at(from), now);
}

std::uint64_t Playback::frame_at(double time) const {
  const auto ns = static_cast<std::int64_t>(std::llround(1e9 * std::clamp(time, 0.0, 1e9)));
  return static_cast<std::uint64_t>(std::lower_bound(times_.begin(), times_.end(), ns) - times_.begin());
}

void Playback::set(std::uint64_t frame, Clock::time_point now) {
  next_ = frame;
  origin_ = now;
  origin_ns_ = is_at_end() ? 0 : times_[next_];
}

std::optional<Playback::Clock::time_point> Playback::due() const {
  if (is_at_end() || (!is_running_ && steps_ == 0)) return std::nullopt;
  if (steps_ > 0) return origin_;
  const std::chrono::duration<double, std::nano> after(static_cast<double>(times_[next_] - origin_ns_) /
                                                       speed_);
  return origin_ + std::chrono::duration_cast<Clock::duration>(after);
}

std::uint64_t Playback::take() {
  if (steps_ > 0) --steps_;
  return next_++;
}

void Playback::obey(const std::string& line, Clock::time_point now) {
  std::istringstream words(line);
  std::string command;
  words >> command;
  if (command == "pause") {
    is_running_ = false;
  } else if (command == "play") {
    is_running_ = true;
    set(next_, now);
  } else if (command == "step") {
    const double frames = words >> std::ws && !words.eof() ? std::round(number(words, line)) : 1;
    const auto count = static_cast<std::int64_t>(std::clamp(frames, -1e9, 1e9));
    is_running_ = false;
    // One back is the frame before the one shown last.
    const auto to =
        count < 0 ? static_cast<std::int64_t>(next_) + count - 1 : static_cast<std::int64_t>(next_);
    set(static_cast<std::uint64_t>(std::max<std::int64_t>(to, 0)), now);
    steps_ = count < 0 ? 1 : static_cast<std::uint64_t>(count);
  } else if (command == "seek") {
    set(frame_at(number(words, line)), now);
    if (!is_running_) steps_ = 1;
  } else if (command == "speed") {
    const double speed = number(words, line);
    if (!(speed > 0)) throw protocol::InputError(fmt::format("a speed of {:g}; it must be positive", speed));
    speed_ = speed;
    set(next_, now);
  } else if (command == "quit") {
    quit_ = true;
  } else if (!command.empty()) {
    refuse(line);
  }
}

}  // namespace sluice::clients
