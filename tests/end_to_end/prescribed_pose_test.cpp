// The recorded pose of a prescribed body is the scene's formula.
#include <cmath>
#include <functional>

#include "protocol/sim_time.hpp"
#include "tests/end_to_end/recorded_run.hpp"

namespace sluice::test {
namespace {

class PrescribedPose : public RecordedRun {
 protected:
  // Compares every recorded step of the gate with its height as a function of time [s].
  void expect_height(const std::vector<std::string>& motion, const std::function<double(double)>& height) {
    std::vector<std::string> options{"--set", "spacing=0.004", "--until", "0.1", "--force"};
    for (const std::string& setting : motion) options.insert(options.end(), {"--set", setting});
    run("rising_gate", "gate.h5", options);
    const clients::Reader recording = read("gate.h5");
    const Welcome& welcome = recording.welcome();
    const protocol::StepClock clock(welcome.interval_ns(), welcome.steps_per_interval(), welcome.steps());
    ASSERT_EQ(recording.exchanges(), clock.steps());
    double largest = 0;
    for (std::uint64_t step = 1; step <= clock.steps(); ++step) {
      const protocol::Message log = recording.exchange_log(step, 1);
      const std::span<const double> row = log.array<double>("kinematics");
      const double t = protocol::seconds(clock.time(step));
      largest = std::max({largest, std::abs(row[0] - 0.102), std::abs(row[1] - height(t)), std::abs(row[2])});
    }
    EXPECT_LE(largest, 1e-12) << "[m]";
  }
};

TEST_F(PrescribedPose, ConstantVelocity) {
  expect_height({}, [](double t) { return 0.06 + 0.7 * t; });
}

TEST_F(PrescribedPose, Expression) {
  expect_height({"body[0].prescribed={expression {y: \"0.05*(1-cos(10*t))\"}}"},
                [](double t) { return 0.06 + 0.05 * (1 - std::cos(10 * t)); });
}

TEST_F(PrescribedPose, KeyframesAtTheirKeysAndBeyond) {
  expect_height(
      {"body[0].prescribed={keyframes {key {time: 0 offset: [0, 0]} key {time: 1 offset: [0, 0]}}}"},
      [](double) { return 0.06; });
}

}  // namespace
}  // namespace sluice::test
