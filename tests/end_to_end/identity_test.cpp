// What a recording makes possible: the same run again, bit for bit.
#include "tests/end_to_end/recorded_run.hpp"

namespace sluice::test {
namespace {

using Identity = RecordedRun;

TEST_F(Identity, TheGateRunsAgainFromItsRecordedMotion) {
  run("rising_gate", "gate.h5", {"--set", "spacing=0.004", "--until", "0.12", "--threads", "1"});
  const Outcome outcome = redrive("gate.h5", "2");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "identical\n");
}

TEST_F(Identity, TheFallingCylinderRunsAgainFromItsRecordedMotion) {
  run("falling_cylinder", "cylinder.h5", {"--set", "spacing=0.022", "--until", "0.3", "--threads", "2"});
  const Outcome outcome = redrive("cylinder.h5", "1");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "identical\n");
}

// Both sides live: the same bits for one and for two threads of the server.
TEST_F(Identity, ThreadsDoNotChangeARun) {
  for (const char* threads : {"1", "2"})
    run("falling_cylinder", std::string(threads) + ".h5",
        {"--set", "spacing=0.022", "--until", "0.2", "--threads", threads});
  const clients::Reader one = read("1.h5"), two = read("2.h5");
  ASSERT_GT(one.frames(), 10u);
  ASSERT_EQ(one.frames(), two.frames());
  for (std::uint64_t k = 0; k < one.frames(); ++k)
    EXPECT_EQ(one.frame_header(k).frame().hash(), two.frame_header(k).frame().hash()) << "frame " << k;
  EXPECT_EQ(one.exchange_log(one.exchanges(), 1).hash_arrays(),
            two.exchange_log(two.exchanges(), 1).hash_arrays());
}

}  // namespace
}  // namespace sluice::test
