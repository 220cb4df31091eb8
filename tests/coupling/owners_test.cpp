// Several participants, each with bodies of its own.

#include <gmock/gmock.h>

#include "server/kinematics_rows.hpp"
#include "tests/coupling/test_server.hpp"

namespace sluice::testing {
namespace {

using protocol::Message;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

// The ball's scene with two gates, before and behind it, that somebody else moves.
Scene ball_and_gates() {
  Scene scene = tank();
  const Scene moved = gate(), free = ball();
  *scene.add_body() = moved.body(0);
  *scene.add_body() = free.body(0);
  *scene.add_body() = moved.body(0);
  scene.mutable_body(0)->set_owner("crane");
  scene.mutable_body(2)->set_owner("crane");
  scene.mutable_body(2)->set_name("other");
  return scene;
}

Message welcome_of(Peer& peer, const std::string& owner) {
  return peer.hello(RIGID, false, false, owner);
}

TEST(Owners, AreToldOfTheirBodiesAlone) {
  TestServer server(ball_and_gates());
  Peer crane(server.endpoint()), rigid(server.endpoint());
  const Message others = welcome_of(crane, "crane"), free = welcome_of(rigid, "");
  EXPECT_THAT(others.header.welcome().body(), ElementsAre(0, 2));
  EXPECT_THAT(free.header.welcome().body(), ElementsAre(1));
  EXPECT_EQ(others.shape("wrenches"), (std::vector<std::uint64_t>{2, 6}));
  EXPECT_EQ(others.array<double>("wrenches")[7], 2);  // that of the scene's third
  EXPECT_EQ(free.shape("wrenches"), (std::vector<std::uint64_t>{1, 6}));
  EXPECT_EQ(others.header.welcome().scene().body_size(), 3);
}

// A step is done when all have sent it, and everyone gets the wrenches of its bodies.
TEST(Owners, MoveTheirBodiesTogether) {
  TestServer server(ball_and_gates(), with_recorder());
  TestRecorder recorder(server.endpoint());
  Peer crane(server.endpoint()), rigid(server.endpoint());
  welcome_of(crane, "crane");
  welcome_of(rigid, "");
  for (std::uint64_t step = 1; step <= server.steps(); ++step) {
    Message gates = kinematics(step, step, 1, 2), ball = kinematics(step, step, 1, 1);
    rigid.send(ball);
    if (step == 1) {
      EXPECT_FALSE(rigid.hears_within(100));  // the crane's are missing
    }
    crane.send(gates);
    const Message to_crane = crane.receive(), to_rigid = rigid.receive();
    ASSERT_TRUE(to_crane.header.has_wrenches()) << to_crane.header.refusal().reason();
    ASSERT_EQ(to_crane.shape("wrenches"), (std::vector<std::uint64_t>{1, 2, 6}));
    EXPECT_THAT(to_crane.array<double>("wrenches").subspan(0, 2), ElementsAre(step, 0));
    EXPECT_THAT(to_crane.array<double>("wrenches").subspan(6, 2), ElementsAre(step, 2));
    EXPECT_THAT(to_rigid.array<double>("wrenches").subspan(0, 2), ElementsAre(step, 1));
  }
  std::uint64_t logged = 0;
  for (const Message& message : recorder.record()) {
    if (!message.header.has_exchange_log()) continue;
    const auto rows = message.array<double>("kinematics");
    for (std::uint64_t k = 0; k < message.header.exchange_log().count(); ++k) {
      ++logged;
      for (std::uint64_t body = 0; body < 3; ++body) {
        const auto row = rows.subspan((3 * k + body) * server::kKinematicsRow, 2);
        EXPECT_THAT(row, ElementsAre(logged, body == 2 ? 1 : 0));  // the crane's second
      }
    }
  }
  EXPECT_EQ(logged, server.steps());
  EXPECT_TRUE(crane.receive().header.has_end());
  EXPECT_EQ(server.outcome().reason, End::FINISHED);
  EXPECT_EQ(server.script.stepped.back().at(2).position,
            Eigen::Vector3d(static_cast<double>(server.steps()), 1, 0));
}

// The rigid process repeats its exchange; the other's motion holds, and its answer waits until that is
// accepted.
TEST(Owners, AreAnsweredWhenAnIteratedExchangeIsAccepted) {
  Scene scene = ball_and_gates();
  scene.mutable_coupling()->set_scheme(IMPLICIT);
  TestServer server(scene);
  Peer crane(server.endpoint()), rigid(server.endpoint());
  EXPECT_EQ(welcome_of(crane, "crane").header.welcome().coupling().scheme(), EXPLICIT);
  EXPECT_EQ(welcome_of(rigid, "").header.welcome().coupling().scheme(), IMPLICIT);
  std::uint64_t sequence = 0;
  for (std::uint64_t step = 1; step <= server.steps(); ++step) {
    Message gates = kinematics(step, step, 1, 2);
    crane.send(gates);
    for (std::uint32_t iteration = 0; iteration < 3; ++iteration) {
      Message ball = kinematics(++sequence, step, 1, 1);
      ball.header.mutable_kinematics()->set_iteration(iteration);
      rigid.send(ball);
      const Message answer = rigid.receive();
      ASSERT_TRUE(answer.header.has_wrenches()) << answer.header.refusal().reason();
    }
    if (step == 1) {
      EXPECT_FALSE(crane.hears_within(100));
    }
    Message accepted;
    accepted.header.mutable_accepted()->set_first_step(step);
    accepted.header.mutable_accepted()->set_count(1);
    accepted.header.mutable_accepted()->set_iterations(3);
    rigid.send(accepted);
    const Message answer = crane.receive();
    ASSERT_TRUE(answer.header.has_wrenches()) << answer.header.refusal().reason();
    EXPECT_EQ(answer.array<double>("wrenches")[0], static_cast<double>(step));
  }
  EXPECT_EQ(server.outcome().reason, End::FINISHED);
  EXPECT_EQ(server.script.stepped.size(), 3 * server.steps());
}

TEST(Owners, OthersAreRefused) {
  TestServer server(ball_and_gates());
  Peer crane(server.endpoint()), second(server.endpoint());
  welcome_of(crane, "crane");
  const Message taken = welcome_of(second, "crane"), unknown = welcome_of(second, "winch");
  EXPECT_EQ(taken.header.refusal().code(), Refusal::ROLE_TAKEN);
  EXPECT_THAT(taken.header.refusal().reason(), HasSubstr("the owner 'crane' of bodies"));
  EXPECT_EQ(unknown.header.refusal().code(), Refusal::NOT_NEEDED);
  EXPECT_THAT(unknown.header.refusal().reason(), HasSubstr("'winch'"));
}

TEST(Owners, OfAllBodiesLeaveNothingToTheRigidProcess) {
  Scene scene = gate();
  scene.mutable_body(0)->set_owner("crane");
  TestServer server(scene);
  Peer rigid(server.endpoint());
  EXPECT_THAT(welcome_of(rigid, "").header.refusal().reason(),
              HasSubstr("every body of the scene has an owner: crane"));
}

TEST(Owners, WhoIsMissingOrLateIsNamed) {
  server::Options options;
  options.start_deadline = std::chrono::milliseconds(200);
  {
    TestServer server(ball_and_gates(), options);
    Peer rigid(server.endpoint());
    welcome_of(rigid, "");
    EXPECT_THAT(server.outcome().detail, HasSubstr("the owner 'crane' of bodies did not join"));
  }
  options = {};
  options.deadline = std::chrono::milliseconds(200);
  TestServer server(ball_and_gates(), options);
  Peer crane(server.endpoint()), rigid(server.endpoint());
  welcome_of(crane, "crane");
  welcome_of(rigid, "");
  Message ball = kinematics(1, 1, 1, 1);
  rigid.send(ball);
  const server::Outcome outcome = server.outcome();
  EXPECT_EQ(outcome.reason, End::PARTICIPANT_TIMEOUT);
  EXPECT_THAT(outcome.detail, HasSubstr("the owner 'crane' of bodies sent no kinematics of step 1"));
}

TEST(Owners, TheLossOfOneEndsTheRun) {
  TestServer server(ball_and_gates());
  Peer rigid(server.endpoint());
  {
    Peer crane(server.endpoint());
    welcome_of(crane, "crane");
    welcome_of(rigid, "");
    Message gates = kinematics(1, 1, 1, 2), ball = kinematics(1, 1, 1, 1);
    crane.send(gates);
    rigid.send(ball);
    rigid.receive();
  }
  const server::Outcome outcome = server.outcome();
  EXPECT_EQ(outcome.reason, End::PARTICIPANT_LOST);
  EXPECT_THAT(outcome.detail, HasSubstr("the owner 'crane' of bodies (test) is gone"));
}

}  // namespace
}  // namespace sluice::testing
