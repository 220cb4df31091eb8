#include "validation/lock_exchange/lock_exchange.hpp"

#include <algorithm>
#include <cmath>

#include "validation/support/budget.hpp"
#include "validation/support/files.hpp"
#include "validation/support/front.hpp"
#include "validation/support/scene_run.hpp"

namespace sluice::validation {
namespace {

// Of the scene: gravity [m/s^2], depth and middle [m], light over heavy.
constexpr double kG = 9.81, kDepth = 0.2, kLock = 0.8, kRatio = 0.5;
// The front has left the start behind from here on and does not see the end wall yet.
constexpr double kFirst = 1 * kDepth, kLast = 2.5 * kDepth;

// Way of the liquid's front from the lock, to the right for the light one [m].
double front(const SceneRun& run, std::uint8_t liquid) {
  const fluid::Snapshot s = run.solver().snapshot();
  std::vector<double> way;
  for (std::size_t i = 0; i < s.density.size(); ++i)
    if (s.liquid[i] == liquid) way.push_back((liquid == 1 ? 1 : -1) * (s.position[3 * i] - kLock));
  return front_of(std::move(way), run.scene().spacing());
}

// Slope of a straight line through the front's way between kFirst and kLast [m/s].
class FrontSpeed {
 public:
  void add(double t, double way) {
    if (way < kFirst || way > kLast) return;
    n_ += 1, t_ += t, x_ += way, tt_ += t * t, tx_ += t * way;
  }
  [[nodiscard]] double speed() const { return (n_ * tx_ - t_ * x_) / (n_ * tt_ - t_ * t_); }

 private:
  double n_ = 0, t_ = 0, x_ = 0, tt_ = 0, tx_ = 0;
};

Outcome run(int resolution, const std::vector<std::string>& overrides, int threads) {
  SceneRun run(case_file("lock_exchange/lock_exchange.scene"), with_spacing(kDepth / resolution, overrides),
               threads);
  // Froude numbers are over this.
  const double scale = std::sqrt((1 - kRatio) * kG * kDepth);
  EnergyRise rise(run);
  FrontSpeed light, heavy;
  while (run.next_output()) {
    light.add(run.time(), front(run, 1));
    heavy.add(run.time(), front(run, 0));
    rise.look(run);
  }
  const double found = light.speed() / scale, error = std::abs(found / 0.5 - 1);
  return run.outcome({{"light front", "% from Benjamin's Froude number 1/2", 100 * error, 10},
                      {"Froude number of the light front", "", found},
                      {"Froude number of the heavy front", "", heavy.speed() / scale},
                      {"energy", "% risen at most", 100 * rise.most() / rise.start(), 0.01}},
                     error);
}

}  // namespace

// Without friction the light front keeps its energy: half the depth, and the speed sqrt((1 - r) g H)/2 at any
// ratio of densities r. T. B. Benjamin, J. Fluid Mech. 31, 1968; experiments from r = 0.6 to 1 agree (R.
// Lowe, J. Rottman, P. Linden, J. Fluid Mech. 537, 2005). The heavy front is faster, and has no such bound.
Case lock_exchange() {
  return {.name = "lock_exchange",
          .title = "Lock exchange of liquids of 2:1 under a lid, particles over H",
          .reference = "Benjamin 1968",
          .resolutions = {5, 10, 20},
          .quick = {10},
          .bound_resolution = 20,
          .run = run};
}

}  // namespace sluice::validation
