// Probes of a run: what they record is what the frames and exchanges say.
#include <cmath>

#include "tests/end_to_end/recorded_run.hpp"

namespace sluice::test {
namespace {

using Probes = RecordedRun;

TEST_F(Probes, MeasureAStillTankAndABodyThatMoves) {
  run("rising_gate", "gate.h5",
      {"--set", "spacing=0.004", "--until", "0.05", "--threads", "1",         //
       "--set", "probe[0]={name: \"floor\" point {position: [0.05, 0.01]}}",  //
       "--set", "probe[1]={name: \"level\" surface {position: [0.03, 0]}}",   //
       "--set", "probe[2]={name: \"gate\" force {body: \"gate\" about: [0.1, 0]}}", "--set",
       "probe[3]={name: \"rider\" point {body: \"gate\" position: [0.097, 0.05]}}"});
  const clients::Reader recording = read("gate.h5");
  const protocol::Message first = recording.frame(0), last = recording.frame(recording.frames() - 1);
  const auto start = first.array<double>("probe"), end = last.array<double>("probe");
  ASSERT_EQ(start.size(), 4u * 6u);
  EXPECT_NEAR(start[0], 1000 * 9.81 * 0.09, 15);  // [Pa] at 9 cm of depth
  EXPECT_NEAR(start[4], 1, 0.05);
  EXPECT_NEAR(start[6], 0.1, 0.001);
  EXPECT_EQ(start[7], 1);
  EXPECT_NEAR(start[18], 1000 * 9.81 * 0.05, 15);
  // The moment about the foot of the gate, from the force and moment about its centre.
  const auto wrench = last.array<double>("body/wrench"), pose = last.array<double>("body/kinematics");
  EXPECT_EQ(end[12], wrench[0]);
  EXPECT_NEAR(end[17], wrench[5] + (pose[0] - 0.1) * wrench[1] - pose[1] * wrench[0],
              1e-12 * std::abs(end[17]) + 1e-12);
  EXPECT_LT(end[18], start[18]);  // it rises with the gate
  EXPECT_EQ(redrive("gate.h5", "2").out, "identical\n");
}

}  // namespace
}  // namespace sluice::test
