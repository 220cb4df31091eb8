#include "clients/sluice/progress.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace sluice::clients {
namespace {

using std::chrono::seconds;

double remaining_seconds(const Position& position) {
  if (position.steps_per_second <= 0) return std::numeric_limits<double>::infinity();
  return static_cast<double>(position.steps - std::min(position.step, position.steps)) /
         position.steps_per_second;
}

}  // namespace

double Position::fraction() const {
  return steps == 0 ? 0 : std::min(1.0, static_cast<double>(step) / static_cast<double>(steps));
}

std::string clock_text(double seconds) {
  if (!(seconds >= 0 && seconds < 1e7)) return "-:--";
  const auto whole = std::llround(seconds);
  if (whole < 3600) return fmt::format("{}:{:02}", whole / 60, whole % 60);
  return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
}

std::string plain_line(const Position& position) {
  return fmt::format("{:5.1f} %  t = {:.4f} / {:.4f} s  {:.0f} steps/s  ETA {}", 100 * position.fraction(),
                     position.time, position.duration, position.steps_per_second,
                     clock_text(remaining_seconds(position)));
}

std::string bar_line(const Position& position, std::size_t columns) {
  const std::string text = plain_line(position);
  const std::size_t frame = 4;  // "[", "]" and two spaces
  if (columns < text.size() + frame + 8) return text.substr(0, columns);
  const std::size_t width = std::min<std::size_t>(columns - text.size() - frame, 40);
  const auto filled = static_cast<std::size_t>(position.fraction() * static_cast<double>(width));
  std::string bar(width, ' ');
  std::fill_n(bar.begin(), filled, '=');
  if (filled < width) bar[filled] = '>';
  return "[" + bar + "]  " + text;
}

bool LineRhythm::due(double fraction, Instant now) {
  const int tenths = static_cast<int>(std::floor(10 * fraction));
  const bool first = tenths_ < 0;
  const bool tenth_passed = tenths > tenths_ && now - last_ >= seconds(2);
  if (!first && !tenth_passed && now - last_ < seconds(60)) return false;
  last_ = now;
  tenths_ = tenths;
  return true;
}

void Progress::show(const Position& position) {
  if (terminal_)
    out_ << '\r' << bar_line(position, columns_) << "\033[K" << std::flush;
  else if (rhythm_.due(position.fraction(), std::chrono::steady_clock::now()))
    out_ << plain_line(position) << std::endl;
}

void Progress::clear() {
  if (terminal_) out_ << "\r\033[K" << std::flush;
}

}  // namespace sluice::clients
