// Bodies made of several plates, each thinner than two supports: nothing passes through them nor through
// their seams, and the water's weight is on them.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "validation/support/files.hpp"
#include "validation/support/scene_run.hpp"

namespace sluice::validation {
namespace {

constexpr double kWeight = 1000 * 9.81;  // rho g [N/m^3]

// How many particles are where `is_dry` says that there should be none.
template <typename IsDry>
int leaked(const SceneRun& run, const IsDry& is_dry) {
  const fluid::Snapshot s = run.solver().snapshot();
  int count = 0;
  for (std::size_t i = 0; i < s.density.size(); ++i)
    count += is_dry(s.position[3 * i], s.position[3 * i + 1]) ? 1 : 0;
  return count;
}

// Mean of what the outputs from `from` [s] on have.
class Mean {
 public:
  explicit Mean(double from) : from_(from) {}
  void add(const SceneRun& run, const Eigen::Vector3d& value) {
    if (run.time() < from_) return;
    sum_ += value;
    ++count_;
  }
  [[nodiscard]] Eigen::Vector3d value() const { return sum_ / count_; }

 private:
  double from_;
  Eigen::Vector3d sum_ = Eigen::Vector3d::Zero();
  int count_ = 0;
};

TEST(ThinCompounds, ABucketHoldsItsWater) {
  SceneRun run(case_file("thin_compounds/bucket.scene"));
  const double water = 0.2 * 0.1 * kWeight;  // [N/m]
  Mean force(0.1);
  while (run.next_output()) {
    ASSERT_EQ(leaked(run, [](double x, double y) { return x < 0.1 || x > 0.3 || y < 0.1; }), 0)
        << "at " << run.time() << " s";
    if (run.time() >= 0.1) {
      EXPECT_LT(run.solver().diagnostics().max_speed, 0.01) << "at " << run.time() << " s";
    }
    force.add(run, run.wrench(0).force);
  }
  std::printf("bucket: force %.2f %% off the water's weight, %.2f %% of it sideways\n",
              100 * (-force.value().y() / water - 1), 100 * force.value().x() / water);
  EXPECT_NEAR(force.value().y(), -water, 0.01 * water);
  EXPECT_NEAR(force.value().x(), 0, 1e-3 * water);
}

// Of water at rest: the highest particle stands half a spacing below it.
double level(const SceneRun& run) {
  const fluid::Snapshot s = run.solver().snapshot();
  double highest = 0;
  for (std::size_t i = 0; i < s.density.size(); ++i) highest = std::max(highest, s.position[3 * i + 1]);
  return highest + run.scene().spacing() / 2;
}

// All pressure goes through the trunnion. The water that the gate's skin cuts off is missing: its level is
// not quite that of the region in the scene.
TEST(ThinCompounds, ARadialGateHasNoMomentAboutItsTrunnion) {
  SceneRun run(case_file("thin_compounds/radial_gate.scene"));
  const double radius = 0.15;  // [m]
  const Eigen::Vector3d trunnion(0.25, 0.05, 0);
  Mean force(0.1), torque(0.1);
  while (run.next_output()) {
    const double behind = radius - run.scene().spacing();  // the gate is a spacing thick
    ASSERT_EQ(leaked(run, [&](double x,
                              double y) { return std::hypot(x - trunnion.x(), y - trunnion.y()) < behind; }),
              0)
        << "at " << run.time() << " s";
    force.add(run, run.wrench(0).force);
    torque.add(run, run.wrench(0).moment);
  }
  const double depth = level(run), thrust = 0.5 * kWeight * depth * depth;  // [m], [N/m]
  std::printf("radial gate: %.4f m of water, thrust %.2f %% off, moment %.2f %% of thrust and radius\n",
              depth, 100 * (force.value().x() / thrust - 1), 100 * torque.value().z() / (thrust * radius));
  EXPECT_NEAR(force.value().x(), thrust, 0.03 * thrust);
  EXPECT_NEAR(torque.value().z(), 0, 0.01 * thrust * radius);
}

}  // namespace
}  // namespace sluice::validation
