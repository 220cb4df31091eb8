#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace sluice::clients {

// Which frame comes next, and when: a clock that runs at a speed and can be stopped and set. Commands, each a
// line: pause | play | step [N] | seek T | speed X | quit, with T in simulated seconds; N frames are shown at
// once, backwards where N is negative, and then the clock stands.
class Playback {
 public:
  using Clock = std::chrono::steady_clock;

  // `times` of the frames [ns], rising. The first is that at or after `from` [s].
  Playback(std::vector<std::int64_t> times, double speed, double from, Clock::time_point now);

  // When the next frame is due; nothing while the clock stands or at the end.
  [[nodiscard]] std::optional<Clock::time_point> due() const;
  // The next frame, which then counts as shown. Precondition: due().
  std::uint64_t take();
  [[nodiscard]] bool is_at_end() const { return next_ >= times_.size(); }
  [[nodiscard]] bool has_quit() const { return quit_; }

  // Throws InputError for a line that is no command.
  void obey(const std::string& line, Clock::time_point now);

 private:
  void set(std::uint64_t frame, Clock::time_point now);
  [[nodiscard]] std::uint64_t frame_at(double time) const;

  std::vector<std::int64_t> times_;
  double speed_;
  std::uint64_t next_ = 0;
  // The next frame at the time that is_running_ counts from.
  std::int64_t origin_ns_ = 0;
  Clock::time_point origin_;
  bool is_running_ = true, quit_ = false;
  std::uint64_t steps_ = 0;  // to be shown at once
};

}  // namespace sluice::clients
