#include "validation/mould_filling/mould_filling.hpp"

#include <algorithm>
#include <cmath>

#include "validation/support/files.hpp"
#include "validation/support/scene_run.hpp"

namespace sluice::validation {
namespace {

// Of the scene, ten times as large as the paper's: the gate's width b, the radii of core and mould, where the
// jet's face starts [m], its speed [m/s].
constexpr double kScale = 10, kWidth = 0.225, kCore = 0.225, kMould = 0.7, kFace = -0.5784, kSpeed = 18;
constexpr std::size_t kCoreBody = 0, kMouldBody = 1;
// The jet's face comes to the core [s].
constexpr double kImpact = (-kCore - kFace) / kSpeed;
// Of the paper's pictures [ms after that, in the paper's size].
constexpr double kPictures[] = {5.76, 8.64, 12.24, 15.60};
// Either half of the jet flows steadily past the core from the first of these on, and leaves what comes back
// from the mould's wall behind it until the second; at the third it is past the ring where its direction is
// measured [s after the impact].
constexpr double kSteady = kWidth / kSpeed, kEnd = kPictures[0] * kScale / 1000, kPast = 3 * kWidth / kSpeed;
constexpr double kRing[2] = {2 * kCore, 2.5 * kCore};

constexpr double kDegree = M_PI / 180;

// What the fluid gave to the bodies [N s], by the kicks of its steps.
class Impulse {
 public:
  void add(const SceneRun& run) {
    const double force = run.wrench(kCoreBody).force.x(), wall = run.wrench(kMouldBody).force.x();
    const double half = 0.5 * (run.time() - time_);
    core_ += half * (force_ + force);
    mould_ += half * (wall_ + wall);
    time_ = run.time(), force_ = force, wall_ = wall;
  }
  [[nodiscard]] double core() const { return core_; }
  [[nodiscard]] double mould() const { return mould_; }

 private:
  double time_ = 0, force_ = 0, wall_ = 0, core_ = 0, mould_ = 0;
};

// Mean direction of what crosses the ring.
class Direction {
 public:
  void add(const fluid::Snapshot& s) {
    for (std::size_t i = 0; i < s.density.size(); ++i) {
      const double x = s.position[3 * i], y = s.position[3 * i + 1], r = std::hypot(x, y);
      if (r < kRing[0] || r > kRing[1] || x < -kCore) continue;
      along_ += s.velocity[3 * i];
      across_ += std::copysign(1.0, y) * s.velocity[3 * i + 1];
    }
  }
  [[nodiscard]] double angle() const { return std::atan2(across_, along_); }

 private:
  double along_ = 0, across_ = 0;
};

// Particles further than half a spacing inside the core or behind the mould's wall.
int lost(const fluid::Snapshot& s, double spacing) {
  int count = 0;
  for (std::size_t i = 0; i < s.density.size(); ++i) {
    const double r = std::hypot(s.position[3 * i], s.position[3 * i + 1]);
    count += r < kCore - 0.5 * spacing || r > kMould + 0.5 * spacing;
  }
  return count;
}

// Share of the particles by which one half has more than the other.
double asymmetry(const fluid::Snapshot& s) {
  double difference = 0;
  for (std::size_t i = 0; i < s.density.size(); ++i) difference += std::copysign(1.0, s.position[3 * i + 1]);
  return std::abs(difference) / static_cast<double>(s.density.size());
}

class Measurement {
 public:
  explicit Measurement(const SceneRun& run) : momentum_(run.solver().diagnostics().momentum.x()) {}

  void add_step(const SceneRun& run) {
    const double since = run.time() - kImpact, rho0 = run.scene().liquid().density();
    impulse_.add(run);
    if (since <= kSteady) steady_from_ = run.time(), steady_impulse_ = impulse_.core();
    if (since <= kEnd)
      force_ = (impulse_.core() - steady_impulse_) / (run.time() - steady_from_) / flow(rho0);
    if (wall_time_ == 0 && impulse_.mould() > 0.05 * flow(rho0) * kWidth / kSpeed) wall_time_ = since;
    const std::size_t next = pictures_.size();
    if (next < std::size(kPictures) && since * 1000 / kScale >= kPictures[next])
      pictures_.push_back({kPictures[next], run.solver().snapshot()});
  }

  void add_output(const SceneRun& run) {
    const fluid::Snapshot state = run.solver().snapshot();
    const double since = run.time() - kImpact;
    if (since > kPast && since <= kEnd) direction_.add(state);
    if (since <= kEnd) early_asymmetry_ = std::max(early_asymmetry_, asymmetry(state));
    asymmetry_ = std::max(asymmetry_, asymmetry(state));
    lost_ = std::max(lost_, lost(state, run.scene().spacing()));
    const fluid::Diagnostics d = run.solver().diagnostics();
    if (since <= kEnd) {
      const double in = flow(run.scene().liquid().density()) * run.time();
      balance_ = std::abs(d.momentum.x() - momentum_ + impulse_.core() + impulse_.mould() - in) / in;
    }
    const double energy = d.kinetic + d.elastic - d.boundary_work;
    if (lowest_ == 0) lowest_ = energy;
    rise_ = std::max(rise_, energy - lowest_);
    lowest_ = std::min(lowest_, energy);
  }

  [[nodiscard]] MouldFillingRun result(const SceneRun& run) const {
    const fluid::Diagnostics d = run.solver().diagnostics();
    const double came_in =
        run.scene().liquid().density() * kWidth * (kSpeed * run.time() + kFace - run.scene().domain().min(0));
    const double error = std::abs(force_ / kSplitJetForce - 1);
    MouldFillingRun result{
        run.outcome({{"force on the core", "% from potential theory", 100 * error, 10},
                     {"jets turned", "degrees from potential theory",
                      std::abs(direction_.angle() / kDegree - kSplitJetAngle), 5},
                     {"momentum", "% not found again", 100 * balance_, 2},
                     {"mass", "% from what the gate lets in", 100 * std::abs(d.mass / came_in - 1), 1},
                     {"particles lost", "", static_cast<double>(lost_), 0},
                     {"halves apart", "% at most, to 5.76 ms", 100 * early_asymmetry_, 1},
                     {"halves apart to the end", "% at most", 100 * asymmetry_},
                     {"energy", "% of what came in risen at most", 100 * rise_ / d.boundary_work, 0.1},
                     {"jets at the wall", "ms after the impact", wall_time_ * 1000 / kScale}},
                    error),
        pictures_};
    // At the end: the mould starts all but empty.
    result.outcome.particles = run.solver().snapshot().density.size();
    return result;
  }

 private:
  // Of momentum through the gate [N/m].
  static double flow(double rho0) { return rho0 * kSpeed * kSpeed * kWidth; }

  double momentum_;  // at the start [kg/s]
  Impulse impulse_;
  Direction direction_;
  double steady_from_ = 0, steady_impulse_ = 0, force_ = 0, balance_ = 0, wall_time_ = 0;
  double early_asymmetry_ = 0, asymmetry_ = 0, lowest_ = 0, rise_ = 0;
  int lost_ = 0;
  std::vector<MouldPicture> pictures_;
};

}  // namespace

MouldFillingRun run_mould_filling(int resolution, const std::vector<std::string>& overrides, int threads) {
  SceneRun run(case_file("mould_filling/mould_filling.scene"), with_spacing(kWidth / resolution, overrides),
               threads);
  Measurement measurement(run);
  while (run.next_step()) {
    measurement.add_step(run);
    if (run.is_output()) measurement.add_output(run);
  }
  return measurement.result(run);
}

// Before what the wall throws back comes to the jet again, the flow past the core is that of a free jet on a
// cylinder, of which potential theory knows force and direction. The paper itself prints pictures only.
Case mould_filling() {
  return {.name = "mould_filling",
          .title = "Mould with a core is filled, to 15.6 ms after the impact, particles over b",
          .reference = "potential theory; Cueto-Felgueroso et al., section 7.3",
          .resolutions = {8, 16, 32},
          .quick = {8},
          .bound_resolution = 32,
          .run = [](int resolution, const std::vector<std::string>& overrides, int threads) {
            return run_mould_filling(resolution, overrides, threads).outcome;
          }};
}

}  // namespace sluice::validation
