#include "benchmark/follow.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "benchmark/escapes.hpp"
#include "server/geometry.hpp"
#include "server/stop.hpp"

namespace sluice::benchmark {
namespace {

// "(0.1, 0.02, 0) m, 0.4 dx from x_min and 0.6 dx from gate": the particle under the highest pressure.
std::string hottest(const validation::SceneRun& run) {
  constexpr double kNear = 2;  // spacings
  const Scene& scene = run.scene();
  const int dimension = static_cast<int>(scene.dimension());
  const fluid::Snapshot s = run.solver().snapshot();
  const auto i =
      static_cast<std::size_t>(std::max_element(s.pressure.begin(), s.pressure.end()) - s.pressure.begin());
  const Eigen::Vector3d x(s.position[3 * i], s.position[3 * i + 1], s.position[3 * i + 2]);
  std::string text = fmt::format("({:.4g}, {:.4g}, {:.4g}) m", x.x(), x.y(), x.z());
  const auto add = [&](double distance, const std::string& name) {
    if (distance < kNear * scene.spacing())
      text += fmt::format(", {:.2g} dx from {}", distance / scene.spacing(), name);
  };
  for (int a = 0; a < dimension; ++a) {
    add(x[a] - scene.domain().min(a), fmt::format("{}_min", "xyz"[a]));
    add(scene.domain().max(a) - x[a], fmt::format("{}_max", "xyz"[a]));
  }
  for (int b = 0; b < scene.body_size(); ++b)
    add(server::distance(server::to_shape(scene.body(b), static_cast<int>(scene.dimension())),
                         run.body(static_cast<std::size_t>(b)), x, dimension),
        scene.body(b).name());
  return text;
}

// Rises of an energy above its least value so far.
class Ledger {
 public:
  explicit Ledger(const validation::SceneRun& run) : run_(run) { follow(); }

  void follow() {
    const fluid::Diagnostics d = run_.solver().diagnostics();
    const double energy = d.kinetic + d.potential + d.elastic - d.boundary_work;
    least_ = std::min(least_, energy);
    scale_ = std::max(scale_, d.kinetic + d.potential);
    compression_ = std::max(compression_, d.max_compression);
    if (energy - least_ <= rise_) return;
    rise_ = energy - least_;
    rise_at_ = run_.time();
    if (rise_ > Faults::kMostRise * scale_) where_ = hottest(run_);
  }

  void report(Faults& faults) const {
    faults.energy_rise = rise_ / scale_;
    faults.rise_at = rise_at_;
    faults.rise_where = where_;
    faults.compression = compression_;
  }

 private:
  const validation::SceneRun& run_;
  double least_ = std::numeric_limits<double>::infinity(), scale_ = 0;  // [J], per metre of depth in 2D
  double rise_ = 0, rise_at_ = 0, compression_ = 0;
  std::string where_;
};

// Whether the state itself is sound, so that only a particle's place can have stopped the run.
bool sound(const validation::SceneRun& run) {
  const fluid::Diagnostics d = run.solver().diagnostics();
  return std::isfinite(d.max_speed) && d.max_speed <= run.scene().liquid().sound_speed() &&
         d.max_compression <= 0.5;
}

}  // namespace

std::string Faults::text() const {
  std::string all;
  const auto add = [&](const std::string& part) { all += (all.empty() ? "" : "; ") + part; };
  if (!stop.empty()) add(stop);
  if (lost > 0) add(fmt::format("{} particles lost from t = {:.4g} s on", lost, lost_at));
  if (energy_rise > kMostRise)
    add(fmt::format("energy has risen by {:.2g} % at t = {:.4g} s, highest pressure at {}", 100 * energy_rise,
                    rise_at, rise_where));
  return all;
}

Faults follow(validation::SceneRun& run) {
  constexpr int kInterval = 4;  // steps between looks at the particles, which move by a fraction of a spacing
  Escapes escapes(run.scene());
  Ledger ledger(run);
  Faults faults;
  const auto look = [&] {
    escapes.follow(run.solver().snapshot());
    if (faults.lost == 0 && escapes.lost() > 0) faults.lost_at = run.time();
    faults.lost = escapes.lost();
  };
  try {
    while (run.next_step()) {
      ledger.follow();
      if (++faults.steps % kInterval == 0) look();
    }
  } catch (const server::Stop& stop) {
    if (!sound(run)) faults.stop = stop.what();
  } catch (const std::runtime_error& error) {  // a body is lost
    faults.stop = error.what();
  }
  look();
  ledger.report(faults);
  faults.particles = run.masses().size();
  faults.end = run.time();
  return faults;
}

}  // namespace sluice::benchmark
