#include <gmock/gmock.h>

#include <algorithm>
#include <limits>

#include "tests/coupling/test_server.hpp"

namespace sluice::testing {
namespace {

using protocol::Message;
using ::testing::HasSubstr;

// A server whose rigid process has joined.
class ExchangeTest : public ::testing::Test {
 protected:
  void join(const Scene& scene) {
    server_ = std::make_unique<TestServer>(scene);
    rigid_ = std::make_unique<Peer>(server_->endpoint());
    ASSERT_TRUE(rigid_->hello(RIGID).header.has_welcome());
  }
  Message ask(Message message) {
    rigid_->send(message);
    return rigid_->receive();
  }
  // Expects a refusal, and that the message as it should have been is then answered: nothing is broken by it.
  void expect_refused(Message bad, Refusal::Code code, const std::string& reason) {
    const Message answer = ask(std::move(bad));
    ASSERT_TRUE(answer.header.has_refusal());
    EXPECT_EQ(answer.header.refusal().code(), code);
    EXPECT_THAT(answer.header.refusal().reason(), HasSubstr(reason));
    EXPECT_TRUE(ask(kinematics(1, 1, 1)).header.has_wrenches());
  }

  std::unique_ptr<TestServer> server_;
  std::unique_ptr<Peer> rigid_;
};

TEST_F(ExchangeTest, StepsInLockStepWithAFreeBody) {
  join(ball());
  const std::vector<double> wrenches = play_rigid(*rigid_, server_->steps(), 1, 1);

  const server::Outcome outcome = server_->outcome();
  EXPECT_EQ(outcome.reason, End::FINISHED) << outcome.detail;
  ASSERT_EQ(server_->script.stepped.size(), 100u);
  ASSERT_EQ(wrenches.size(), 600u);
  for (std::size_t n = 1; n <= 100; ++n) {
    EXPECT_EQ(server_->script.stepped[n - 1].at(0).position.x(), static_cast<double>(n));
    EXPECT_EQ(wrenches[6 * (n - 1)], static_cast<double>(n));
  }
}

// Forces on the gate and its moment about the origin, from a force probe.
Scene probed_gate() {
  Scene scene = gate();
  scene.MergeFrom(parse_scene(R"(probe { name: "load" force { body: "gate" } })"));
  return scene;
}

bool has_probes(const Message& message) {
  const auto& arrays = message.header.array();
  return std::any_of(arrays.begin(), arrays.end(), [](const Array& a) { return a.name() == "probe"; });
}

TEST_F(ExchangeTest, ProbesComeWithTheAnswerThatEndsWithAnOutputToWhoAskedForThem) {
  server_ = std::make_unique<TestServer>(probed_gate());
  rigid_ = std::make_unique<Peer>(server_->endpoint());
  const Message welcome = rigid_->hello(RIGID, false, true);
  EXPECT_EQ(welcome.shape("probe"), (std::vector<std::uint64_t>{1, 6}));
  EXPECT_EQ(welcome.array<double>("probe")[0], 0.0);
  for (std::uint64_t step = 1; step <= 20; ++step) {
    const Message answer = ask(kinematics(step, step, 1));
    ASSERT_EQ(has_probes(answer), step % 10 == 0) << step;
    if (step % 10 == 0) {
      EXPECT_EQ(answer.array<double>("probe")[0], static_cast<double>(step));
    }
  }
  // The same again is the same answer, probes and all.
  EXPECT_TRUE(has_probes(ask(kinematics(20, 20, 1))));
}

TEST_F(ExchangeTest, WithoutAskingNoProbesCome) {
  join(probed_gate());
  for (std::uint64_t step = 1; step <= 10; ++step)
    EXPECT_FALSE(has_probes(ask(kinematics(step, step, 1)))) << step;
}

TEST_F(ExchangeTest, StartsTheSolverWithTheScenesPosesAndVelocities) {
  join(ball());
  play_rigid(*rigid_, server_->steps(), 1, 1);
  server_->outcome();
  ASSERT_EQ(server_->script.started.size(), 1u);
  EXPECT_EQ(server_->script.started[0].position, Eigen::Vector3d(0.5, 1.2, 0));
  EXPECT_EQ(server_->script.started[0].velocity, Eigen::Vector3d(0, -1, 0));
}

TEST_F(ExchangeTest, StreamedBatchesGiveWhatSingleStepsGive) {
  join(gate());
  const std::vector<double> streamed = play_rigid(*rigid_, server_->steps(), 64, 2);
  server_->outcome();
  const auto streamed_poses = std::move(server_->script.stepped);

  join(gate());
  const std::vector<double> single = play_rigid(*rigid_, server_->steps(), 1, 1);
  server_->outcome();

  EXPECT_EQ(streamed, single);
  ASSERT_EQ(streamed_poses.size(), server_->script.stepped.size());
  for (std::size_t n = 0; n < streamed_poses.size(); ++n) {
    EXPECT_EQ(streamed_poses[n].at(0).position, server_->script.stepped[n].at(0).position);
  }
}

TEST_F(ExchangeTest, PassesKinematicsOnBitForBit) {
  join(ball());
  std::vector<double> row;
  for (int i = 0; i < 19; ++i) row.push_back(1.0 / (3 + i));
  const Eigen::Vector4d q = Eigen::Vector4d(0.1, -0.5, 0.7, 0.2).normalized();
  for (int i = 0; i < 4; ++i) row[3 + static_cast<std::size_t>(i)] = q[i];
  Message message;
  message.header.set_sequence(1);
  message.header.mutable_kinematics()->set_first_step(1);
  message.header.mutable_kinematics()->set_count(1);
  message.add_array<double>("kinematics", row, {1, 1, 19});
  ASSERT_TRUE(ask(std::move(message)).header.has_wrenches());
  server_->interrupt();
  EXPECT_EQ(server_->outcome().reason, End::INTERRUPTED);

  std::vector<double> seen;
  server::append(seen, server_->script.stepped.at(0).at(0));
  EXPECT_EQ(seen, row);
}

TEST_F(ExchangeTest, AnswersTheSameSequenceWithTheSameReply) {
  join(ball());
  const Message first = ask(kinematics(1, 1, 1));
  const Message again = ask(kinematics(1, 1, 1));
  EXPECT_EQ(again.header.SerializeAsString(), first.header.SerializeAsString());
  EXPECT_EQ(again.hash_arrays(), first.hash_arrays());
  EXPECT_EQ(ask(kinematics(2, 2, 1)).header.wrenches().first_step(), 2u);  // and has not stepped twice
}

TEST_F(ExchangeTest, StampsReplies) {
  join(ball());
  const Message answer = ask(kinematics(1, 1, 1));
  EXPECT_EQ(answer.header.sequence(), 1u);
  EXPECT_EQ(answer.header.step(), 1u);
  EXPECT_EQ(answer.header.time_ns(), 1'000'000);
  EXPECT_EQ(answer.header.wrenches().count(), 1u);
}

TEST_F(ExchangeTest, RefusesAWrongSequenceNamingBoth) {
  join(ball());
  expect_refused(kinematics(7, 1, 1), Refusal::BAD_SEQUENCE, "sequence 7 came, expected 1");
}

TEST_F(ExchangeTest, RefusesStepsThatDoNotFollow) {
  join(ball());
  expect_refused(kinematics(1, 3, 1), Refusal::BAD_SEQUENCE, "step 3 came, expected step 1");
}

TEST_F(ExchangeTest, RefusesSeveralStepsInLockStep) {
  join(ball());
  expect_refused(kinematics(1, 1, 2), Refusal::BAD_MESSAGE, "allowed are 1 to 1");
}

TEST_F(ExchangeTest, RefusesNoStepAndStepsBeyondTheEnd) {
  join(gate());
  EXPECT_EQ(ask(kinematics(1, 1, 0)).header.refusal().code(), Refusal::BAD_MESSAGE);
  expect_refused(kinematics(1, 1, 101), Refusal::BAD_MESSAGE, "allowed are 1 to 100");
}

TEST_F(ExchangeTest, RefusesAWrongNumberOfBodies) {
  join(ball());
  expect_refused(kinematics(1, 1, 1, 2), Refusal::BAD_MESSAGE, "shape [1, 2, 19], expected [1, 1, 19]");
}

TEST_F(ExchangeTest, RefusesNumbersThatAreNotFinite) {
  join(ball());
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    Message message = kinematics(1, 1, 1);
    static_cast<double*>(message.frames[0].data())[8] = bad;
    const Message answer = ask(std::move(message));
    EXPECT_EQ(answer.header.refusal().code(), Refusal::BAD_MESSAGE);
    EXPECT_THAT(answer.header.refusal().reason(), HasSubstr("body 0 at step 1: entry 8"));
  }
}

TEST_F(ExchangeTest, RefusesQuaternionsThatAreNotOfUnitLength) {
  join(ball());
  Message message = kinematics(1, 1, 1);
  static_cast<double*>(message.frames[0].data())[3] = 1.00001;
  expect_refused(std::move(message), Refusal::BAD_MESSAGE, "length is 1.00001");
}

TEST_F(ExchangeTest, RefusesMissingKinematicsAndOtherContent) {
  join(ball());
  Message empty;
  empty.header.set_sequence(1);
  empty.header.mutable_kinematics()->set_first_step(1);
  empty.header.mutable_kinematics()->set_count(1);
  EXPECT_EQ(ask(std::move(empty)).header.refusal().code(), Refusal::BAD_MESSAGE);

  Message other;
  other.header.mutable_acknowledgement()->set_sequence(1);
  expect_refused(std::move(other), Refusal::BAD_MESSAGE, "not for the role RIGID");
}

TEST_F(ExchangeTest, EndsTheRunOfAParticipantThatDoesNotAnswer) {
  server::Options options;
  options.deadline = std::chrono::milliseconds(100);
  TestServer server(ball(), options);
  Peer rigid(server.endpoint());
  rigid.hello(RIGID);
  const server::Outcome outcome = server.outcome();
  EXPECT_EQ(outcome.reason, End::PARTICIPANT_TIMEOUT);
  EXPECT_THAT(outcome.detail, HasSubstr("no kinematics of step 1 within 0.1 s"));
  EXPECT_EQ(rigid.receive().header.end().reason(), End::PARTICIPANT_TIMEOUT);
}

TEST_F(ExchangeTest, EndsTheRunOfAParticipantThatLeaves) {
  join(ball());
  ASSERT_TRUE(ask(kinematics(1, 1, 1)).header.has_wrenches());
  rigid_.reset();
  const server::Outcome outcome = server_->outcome();
  EXPECT_EQ(outcome.reason, End::PARTICIPANT_LOST);
  EXPECT_EQ(outcome.steps, 1u);
}

TEST_F(ExchangeTest, NamesTheLastRefusalWhenTheParticipantLeavesOverIt) {
  join(ball());
  ask(kinematics(1, 1, 1));  // answered: the run goes on, and leaving ends it
  ask(kinematics(7, 2, 1));
  rigid_.reset();
  EXPECT_THAT(server_->outcome().detail, HasSubstr("sequence 7 came, expected 2"));
}

TEST_F(ExchangeTest, AnInterruptEndsTheRunInGoodOrder) {
  join(ball());
  server_->interrupt();
  EXPECT_EQ(rigid_->receive().header.end().reason(), End::INTERRUPTED);
  EXPECT_EQ(server_->outcome().reason, End::INTERRUPTED);
}

// An iterated exchange goes back to the state before it; what is logged is the last iteration, with what the
// rigid process says of it.
TEST_F(ExchangeTest, RepeatsAnExchangeFromTheStateBeforeIt) {
  Scene scene = ball();
  scene.mutable_coupling()->set_scheme(IMPLICIT);
  scene.mutable_coupling()->set_steps_per_exchange(4);
  TestServer server(scene, with_recorder());
  TestRecorder recorder(server.endpoint());
  Peer rigid(server.endpoint());
  const Message welcome = rigid.hello(RIGID);
  EXPECT_EQ(welcome.header.welcome().coupling().scheme(), IMPLICIT);
  EXPECT_EQ(welcome.header.welcome().stability_size(), 1);
  std::uint64_t sequence = 0;
  // Ten steps to an output: exchanges of 4, 4 and 2 steps.
  for (std::uint64_t first = 1; first <= server.steps();) {
    const std::uint32_t count = (first - 1) % 10 == 8 ? 2 : 4;
    for (std::uint32_t iteration = 0; iteration < 3; ++iteration) {
      Message steps = kinematics(++sequence, first, count);
      steps.header.mutable_kinematics()->set_iteration(iteration);
      rigid.send(steps);
      const Message answer = rigid.receive();
      ASSERT_TRUE(answer.header.has_wrenches()) << answer.header.refusal().reason();
      EXPECT_EQ(answer.array<double>("wrenches")[0], static_cast<double>(first));
    }
    Message accepted;
    accepted.header.mutable_accepted()->set_first_step(first);
    accepted.header.mutable_accepted()->set_count(count);
    accepted.header.mutable_accepted()->set_iterations(3);
    accepted.header.mutable_accepted()->set_residual(0.5);
    rigid.send(accepted);
    first += count;
  }
  std::uint64_t logged = 0;
  for (const Message& message : recorder.record()) {
    if (!message.header.has_exchange_log()) continue;
    const auto wrenches = message.array<double>("wrenches");
    const auto coupling = message.array<double>("coupling");
    for (std::uint64_t k = 0; k < message.header.exchange_log().count(); ++k) {
      EXPECT_EQ(wrenches[6 * k], static_cast<double>(++logged));
      EXPECT_EQ(coupling[2 * k], 3);
      EXPECT_EQ(coupling[2 * k + 1], 0.5);
    }
  }
  EXPECT_EQ(logged, server.steps());
  EXPECT_EQ(server.outcome().reason, End::FINISHED);
  EXPECT_EQ(server.script.stepped.size(), 3 * server.steps());
}

}  // namespace
}  // namespace sluice::testing
