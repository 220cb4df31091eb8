#include "server/progress.hpp"

namespace sluice::server {

double Progress::rate(std::uint64_t steps_done) {
  constexpr double kShare = 0.1;  // of the newest report in the average
  const Clock::time_point now = Clock::now();
  const double elapsed = seconds(now - reported_);
  if (elapsed > 0 && steps_done > steps_) {
    const double newest = static_cast<double>(steps_done - steps_) / elapsed;
    rate_ = rate_ == 0 ? newest : rate_ + kShare * (newest - rate_);
  }
  reported_ = now;
  steps_ = steps_done;
  return rate_;
}

}  // namespace sluice::server
