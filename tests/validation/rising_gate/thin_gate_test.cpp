#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "protocol/scene_file.hpp"
#include "validation/rising_gate/gate.hpp"
#include "validation/support/files.hpp"

namespace sluice::validation {
namespace {

// Of thin_gate.scene [m].
constexpr Gate kGate{0.100, 0.104, 0.06};
constexpr double kDepth = 0.1, kShallow = 0.024, kShut = 1.0;
constexpr double kWeight = 1000 * 9.81;  // rho g [N/m^3]

double hydrostatic_force(double depth) {
  return 0.5 * kWeight * depth * depth;
}

// Mean and standard deviation of values as they come.
class Spread {
 public:
  void add(double value) {
    ++count_;
    sum_ += value;
    squares_ += value * value;
  }
  [[nodiscard]] double mean() const { return sum_ / count_; }
  [[nodiscard]] double deviation() const {
    return std::sqrt(std::max(0.0, squares_ / count_ - mean() * mean()));
  }

 private:
  double count_ = 0, sum_ = 0, squares_ = 0;
};

double rightmost(const SceneRun& run) {
  const fluid::Snapshot s = run.solver().snapshot();
  double x = 0;
  for (std::size_t i = 0; i < s.density.size(); ++i) x = std::max(x, s.position[3 * i]);
  return x;
}

double force_on_thick_gate() {
  SceneRun run(case_file("rising_gate/thin_gate.scene"),
               {"duration=0.3", "body[0].box.size=[0.04, 0.12]", "body[0].position=[0.12, 0.06]"});
  Spread force;
  while (run.next_output())
    if (run.time() >= 0.1) force.add(run.wrench(0).force.x());
  return force.mean();
}

// The largest difference between the pressure of particles within `reach` of the gate's right face and that
// of water at rest there.
double difference_beside(const SceneRun& run, double reach) {
  const fluid::Snapshot s = run.solver().snapshot();
  double largest = 0;
  for (std::size_t i = 0; i < s.density.size(); ++i) {
    const double x = s.position[3 * i], y = s.position[3 * i + 1];
    if (x < kGate.right || x > kGate.right + reach) continue;
    largest = std::max(largest, std::abs(s.pressure[i] - kWeight * (kShallow - y)));
  }
  return largest;
}

// One side wet, the other dry, for 1 s; then it rises. A gate ten times as thick feels the same force.
TEST(ThinGate, OfOneSpacingLetsNothingThrough) {
  SceneRun run(case_file("rising_gate/thin_gate.scene"));
  Spread force;
  while (run.time() < kShut - 1e-6 && run.next_output()) {
    ASSERT_EQ(kGate.leaked(run), 0) << "at " << run.time() << " s";
    ASSERT_LE(rightmost(run), kGate.left) << "at " << run.time() << " s";
    if (run.time() < 0.1) continue;
    force.add(run.wrench(0).force.x());
    EXPECT_LT(run.solver().diagnostics().max_speed, 0.01) << "at " << run.time() << " s";
  }
  EXPECT_NEAR(force.mean(), hydrostatic_force(kDepth), 0.02 * hydrostatic_force(kDepth));
  EXPECT_LT(force.deviation(), 5e-3 * force.mean());
  EXPECT_NEAR(force.mean(), force_on_thick_gate(), 1e-3 * force.mean());
  std::printf("shut: force %.2f %% off, deviation %.3f %%\n",
              100 * (force.mean() / hydrostatic_force(kDepth) - 1), 100 * force.deviation() / force.mean());

  while (run.next_output()) ASSERT_EQ(kGate.leaked(run), 0) << "at " << run.time() << " s";
  EXPECT_GT(kGate.foot(run), kDepth);
  EXPECT_GT(rightmost(run), 0.35);
}

// Deep water on one side, shallow on the other. Through the gate nothing is seen; the floor's particles under
// its foot have one pressure for both sides, and pass on a little to the first particles there.
TEST(ThinGate, OfOneSpacingHidesThePressureBehindIt) {
  Scene scene = protocol::SceneFile::load(case_file("rising_gate/thin_gate.scene"), {"duration=1"}).scene();
  Span& shallow = *scene.add_fluid()->mutable_box();
  for (const double x : {kGate.right, 0.0}) shallow.add_min(x);
  for (const double x : {0.4, kShallow}) shallow.add_max(x);
  SceneRun run(scene);
  Spread force;
  double difference = 0;
  while (run.next_output()) {
    if (run.time() < 0.3) continue;  // the shallow water's rows come to rest against the gate
    force.add(run.wrench(0).force.x());
    difference = std::max(difference, difference_beside(run, 2 * run.scene().spacing()));
  }
  const double expected = hydrostatic_force(kDepth) - hydrostatic_force(kShallow);
  EXPECT_NEAR(force.mean(), expected, 0.02 * expected);
  EXPECT_LT(force.deviation(), 0.01 * expected);
  EXPECT_LT(difference, 0.025 * kWeight * kDepth);
  std::printf(
      "two depths: force %.2f %% off, deviation %.2f %%; pressure beside it %.1f %% of the deep water's "
      "off\n",
      100 * (force.mean() / expected - 1), 100 * force.deviation() / expected,
      100 * difference / (kWeight * kDepth));
}

}  // namespace
}  // namespace sluice::validation
