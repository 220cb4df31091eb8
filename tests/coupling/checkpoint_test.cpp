// When the server writes checkpoints, what is in them, and how a run goes on from one.
#include <gmock/gmock.h>

#include "tests/coupling/test_server.hpp"

namespace sluice::testing {
namespace {

using protocol::Message;
using ::testing::HasSubstr;

// A rigid process that gives its state. Outputs are every ten steps.
class CheckpointTest : public ::testing::Test {
 protected:
  [[nodiscard]] server::Options options(double every = 0) const {
    server::Options options;
    options.deadline = std::chrono::milliseconds(kPatience);
    options.checkpoint = {.file = file_, .every = every};
    return options;
  }

  static Message state(std::uint64_t step, const std::vector<double>& numbers) {
    Message message;
    message.header.mutable_state()->set_step(step);
    message.header.mutable_state()->set_build("rigid");
    message.add_array<double>("state", numbers, {numbers.size()});
    return message;
  }

  // Steps first .. last, one a message; the state is (step, 0.1, -0).
  static void play(Peer& rigid, std::uint64_t first, std::uint64_t last, std::uint64_t sequence = 0) {
    for (std::uint64_t step = first; step <= last; ++step) {
      Message motion = kinematics(++sequence, step, 1);
      rigid.send(motion);
      ASSERT_TRUE(rigid.receive().header.has_wrenches());
      if (step % 10 != 0) continue;
      Message now = state(step, {static_cast<double>(step), 0.1, -0.0});
      rigid.send(now);
    }
  }

  [[nodiscard]] protocol::CheckpointFile written() const { return protocol::read_checkpoint(file_); }

  Directory directory_;
  std::filesystem::path file_ = directory_.path() / "run.checkpoint";
};

TEST_F(CheckpointTest, HoldsTheLastOutputWhenTheRunIsInterrupted) {
  TestServer server(ball(), options());
  Peer rigid(server.endpoint());
  const Message welcome = rigid.hello(RIGID, true);
  EXPECT_TRUE(welcome.header.welcome().wants_state());
  play(rigid, 1, 34);
  server.interrupt();
  const server::Outcome outcome = server.outcome();
  EXPECT_EQ(outcome.reason, End::INTERRUPTED);
  EXPECT_THAT(outcome.detail, HasSubstr("checkpoint at 0.03 s: " + file_.string()));
  const protocol::CheckpointFile found = written();
  EXPECT_EQ(found.header.step(), 30u);
  EXPECT_EQ(found.header.time_ns(), 30'000'000);
  EXPECT_EQ(found.header.run_id(), welcome.header.run_id());
  EXPECT_EQ(found.header.rigid_build(), "rigid");
  EXPECT_FALSE(found.header.recorded());
  EXPECT_EQ(found.rigid, (std::vector<double>{30, 0.1, -0.0}));
}

TEST_F(CheckpointTest, HoldsTheLastGoodStateOfAnUnstableRun) {
  SolverScript script;
  script.spoil = [](std::uint64_t step, fluid::Snapshot& state) {
    if (step == 33) state.velocity[4] = std::numeric_limits<double>::quiet_NaN();
  };
  TestServer server(ball(), options(), script);
  Peer rigid(server.endpoint());
  rigid.hello(RIGID, true);
  play(rigid, 1, 39);
  Message motion = kinematics(40, 40, 1);
  rigid.send(motion);
  EXPECT_EQ(server.outcome().reason, End::UNSTABLE);
  EXPECT_EQ(written().header.step(), 30u);
}

TEST_F(CheckpointTest, GoesOnWhereItWas) {
  {
    TestServer server(ball(), options(0.02));
    Peer rigid(server.endpoint());
    rigid.hello(RIGID, true);
    play(rigid, 1, 49);
  }
  ASSERT_EQ(written().header.step(), 40u);
  TestServer server(written(), options());
  Peer rigid(server.endpoint());
  const Message welcome = rigid.hello(RIGID, true);
  EXPECT_EQ(welcome.header.welcome().done(), 40u);
  EXPECT_EQ(welcome.header.run_id(), written().header.run_id());
  EXPECT_EQ(welcome.header.welcome().state_build(), "rigid");
  EXPECT_EQ(welcome.array<double>("state")[0], 40);
  EXPECT_TRUE(std::signbit(welcome.array<double>("state")[2]));
  EXPECT_EQ(welcome.array<double>("wrenches")[0], 40);  // the solver's, after that step

  Message first = kinematics(1, 1, 1);
  rigid.send(first);
  EXPECT_THAT(rigid.receive().header.refusal().reason(), HasSubstr("expected step 41"));
  play(rigid, 41, 100);
  EXPECT_EQ(server.outcome().reason, End::FINISHED);
  EXPECT_EQ(server.script.stepped.size(), 60u);
}

TEST_F(CheckpointTest, IsThereAtEveryMultipleThatIsAskedFor) {
  TestServer server(ball(), options(0.03));
  Peer rigid(server.endpoint());
  rigid.hello(RIGID, true);
  play(rigid, 1, 100);
  EXPECT_EQ(server.outcome().reason, End::FINISHED);
  EXPECT_EQ(written().header.step(), 100u);  // the end, since they are wanted
  EXPECT_EQ(protocol::read_checkpoint(protocol::previous_checkpoint(file_)).header.step(), 90u);
}

TEST_F(CheckpointTest, IsNotWrittenBeforeTheRecorderHasWhatWentBefore) {
  server::Options with = options(0.01);
  with.expect_recorder = true;
  TestServer server(ball(), with);
  TestRecorder recorder(server.endpoint());
  Peer rigid(server.endpoint());
  rigid.hello(RIGID, true);
  play(rigid, 1, 10);
  std::uint64_t last = 0;
  while (auto message = recorder.pull()) {
    last = message->header.sequence();
    if (message->header.has_frame() && message->header.frame().index() == 1) break;
  }
  EXPECT_FALSE(std::filesystem::exists(file_));
  recorder.acknowledge(last);
  play(rigid, 11, 11, 10);  // the answer comes after the checkpoint
  EXPECT_EQ(written().header.step(), 10u);
  EXPECT_TRUE(written().header.recorded());
}

TEST_F(CheckpointTest, ARecorderThatIsLostTakesTheUnrecordedOnesWithIt) {
  server::Options with = options();
  with.expect_recorder = true;
  TestServer server(ball(), with);
  Peer rigid(server.endpoint());
  {
    TestRecorder recorder(server.endpoint());
    rigid.hello(RIGID, true);
    play(rigid, 1, 15);
  }
  EXPECT_EQ(server.outcome().reason, End::RECORDER_LOST);
  EXPECT_FALSE(std::filesystem::exists(file_));
}

// A run whose participant keeps its state for itself is none the worse.
TEST_F(CheckpointTest, NeedsAParticipantThatGivesItsState) {
  TestServer server(ball(), options(0.01));
  Peer rigid(server.endpoint());
  rigid.hello(RIGID, false);
  play_rigid(rigid, server.steps(), 1, 1);
  EXPECT_EQ(server.outcome().reason, End::FINISHED);
  EXPECT_FALSE(std::filesystem::exists(file_));
}

TEST_F(CheckpointTest, EndsTheRunOfAParticipantThatDoesNotGiveIt) {
  server::Options impatient = options(0.01);
  impatient.deadline = std::chrono::milliseconds(300);
  TestServer server(ball(), impatient);
  Peer rigid(server.endpoint());
  rigid.hello(RIGID, true);
  play(rigid, 1, 9);
  Message motion = kinematics(10, 10, 1);
  rigid.send(motion);
  const server::Outcome outcome = server.outcome();
  EXPECT_EQ(outcome.reason, End::PARTICIPANT_TIMEOUT);
  EXPECT_THAT(outcome.detail, HasSubstr("did not give its state after step 10"));
}

TEST_F(CheckpointTest, RefusesAStateOfAnotherStep) {
  TestServer server(ball(), options());
  Peer rigid(server.endpoint());
  rigid.hello(RIGID, true);
  play(rigid, 1, 5);
  Message early = state(5, {1});
  rigid.send(early);
  EXPECT_THAT(rigid.receive().header.refusal().reason(), HasSubstr("state after step 5"));
  Message bare;
  bare.header.mutable_state()->set_step(10);
  play(rigid, 6, 9, 5);
  Message motion = kinematics(10, 10, 1);
  rigid.send(motion);
  ASSERT_TRUE(rigid.receive().header.has_wrenches());
  rigid.send(bare);
  EXPECT_THAT(rigid.receive().header.refusal().reason(), HasSubstr("no array state"));
}

// Prescribed bodies have no state of their own, and nobody is asked for it.
TEST_F(CheckpointTest, OfPrescribedBodiesHoldsTheFluidAlone) {
  TestServer server(gate(), options(0.05));
  Peer rigid(server.endpoint());
  EXPECT_FALSE(rigid.hello(RIGID, true).header.welcome().wants_state());
  play_rigid(rigid, server.steps(), 64, 2);
  EXPECT_EQ(server.outcome().reason, End::FINISHED);
  EXPECT_EQ(written().header.step(), 100u);
  EXPECT_TRUE(written().rigid.empty());
}

}  // namespace
}  // namespace sluice::testing
