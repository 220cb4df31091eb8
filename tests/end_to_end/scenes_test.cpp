// The first part of every scene with bodies, coarser: it runs to its end, and the bodies do what they should.
#include <cmath>

#include "tests/end_to_end/recorded_run.hpp"

namespace sluice::test {
namespace {

class Scenes : public RecordedRun {
 protected:
  // The recorded kinematics of a body over all steps, 19 columns.
  void run_scene(const std::string& scene, const std::string& spacing, const std::string& until) {
    run(scene, "run.h5", {"--set", "spacing=" + spacing, "--until", until, "--threads", "1"});
    const clients::Reader recording = read("run.h5");
    bodies_ = static_cast<std::size_t>(recording.scene().body_size());
    for (std::uint64_t step = 1; step <= recording.exchanges(); ++step) {
      const protocol::Message log = recording.exchange_log(step, 1);
      const auto row = log.array<double>("kinematics");
      rows_.insert(rows_.end(), row.begin(), row.end());
    }
    ASSERT_GT(steps(), 10u);
  }

  [[nodiscard]] std::size_t steps() const { return rows_.size() / (19 * bodies_); }
  [[nodiscard]] double value(std::size_t step, std::size_t body, int column) const {
    return rows_.at((step * bodies_ + body) * 19 + static_cast<std::size_t>(column));
  }
  [[nodiscard]] double last(std::size_t body, int column) const { return value(steps() - 1, body, column); }

 private:
  std::size_t bodies_ = 0;
  std::vector<double> rows_;
};

TEST_F(Scenes, WedgeIsSlowedByTheWaterAndStaysUpright) {
  run_scene("falling_wedge", "0.025", "0.03");
  EXPECT_LT(last(0, 1), 0.95);
  EXPECT_GT(last(0, 8), -6.15);
  EXPECT_EQ(last(0, 6), 0);
}

TEST_F(Scenes, SphereEntersTheWater) {
  run_scene("falling_sphere", "0.025", "0.06");
  EXPECT_LT(last(0, 2), 0.25);
  EXPECT_NEAR(last(0, 0), 0.2, 0.005);
}

TEST_F(Scenes, BoxRisesAndRollsBack) {
  run_scene("floating_box", "0.02", "0.15");
  EXPECT_GT(last(0, 8), 0);                    // it floats up
  EXPECT_LT(2 * std::asin(last(0, 6)), 0.15);  // and turns upright
}

TEST_F(Scenes, BlockSinks) {
  run_scene("sinking_block", "0.02", "0.15");
  EXPECT_LT(last(0, 1), 0.45);
}

TEST_F(Scenes, GateRisesByItsTableAndDropsWithoutAJump) {
  run_scene("dropped_gate", "0.008", "0.45");
  double highest = 0, jump = 0;
  for (std::size_t n = 1; n < steps(); ++n) {
    highest = std::max(highest, value(n, 0, 1));
    jump = std::max(jump, std::abs(value(n, 0, 8) - value(n - 1, 0, 8)));
    ASSERT_EQ(value(n, 0, 0), value(0, 0, 0));
  }
  EXPECT_NEAR(highest, 0.18, 1e-6);
  EXPECT_LT(jump, 0.05);
  EXPECT_LT(last(0, 1), 0.17);
}

TEST_F(Scenes, FlapStaysOnItsHinge) {
  run_scene("flap_in_waves", "0.04", "0.5");
  for (std::size_t n = 0; n < steps(); ++n) {
    const double angle = 2 * std::atan2(value(n, 1, 6), value(n, 1, 3));
    ASSERT_NEAR(value(n, 1, 0) + 0.26 * std::sin(angle), 5.2, 1e-10);
    ASSERT_NEAR(value(n, 1, 1) - 0.26 * std::cos(angle), 0.06, 1e-10);
  }
}

TEST_F(Scenes, StackStandsUntilTheWaterComes) {
  run_scene("box_stack", "0.04", "0.1");
  for (const std::size_t body : {0u, 1u, 2u}) {
    EXPECT_NEAR(last(body, 0), 0.9, 1e-4);
    EXPECT_NEAR(last(body, 2), 0.06 + 0.12 * static_cast<double>(body), 1e-4);
  }
}

}  // namespace
}  // namespace sluice::test
