#include <gmock/gmock.h>

#include "tests/coupling/test_server.hpp"

namespace sluice::testing {
namespace {

using protocol::Message;
using ::testing::HasSubstr;

TEST(Handshake, WelcomesTheRigidProcessWithSceneClockAndFirstWrenches) {
  TestServer server(ball());
  Peer rigid(server.endpoint());
  const Message welcome = rigid.hello(RIGID);

  ASSERT_TRUE(welcome.header.has_welcome());
  const Welcome& content = welcome.header.welcome();
  EXPECT_EQ(content.scene().name(), "tank");
  EXPECT_EQ(content.scene().liquid().sound_speed(), 40);  // defaults are filled in
  EXPECT_EQ(content.interval_ns(), 10'000'000);
  EXPECT_EQ(content.steps_per_interval(), 10u);
  EXPECT_EQ(content.steps(), 100u);
  EXPECT_EQ(content.fluid_particles(), 50u);
  EXPECT_NE(welcome.header.session_token(), 0u);
  EXPECT_FALSE(welcome.header.run_id().empty());
  EXPECT_EQ(welcome.shape("wrenches"), (std::vector<std::uint64_t>{1, 6}));
  EXPECT_EQ(welcome.array<double>("wrenches")[2], 1);
}

TEST(Handshake, WelcomesAWatcherWithTheBoundaries) {
  TestServer server(ball());
  Peer watcher(server.endpoint());
  const Message welcome = watcher.hello(WATCHER);

  ASSERT_TRUE(welcome.header.has_welcome());
  const std::size_t walls = welcome.shape("wall/position").at(0),
                    bodies = welcome.shape("boundary/position").at(0);
  EXPECT_GT(walls, 0u);
  EXPECT_GT(bodies, 0u);
  EXPECT_EQ(welcome.header.welcome().boundary_particles(), walls + bodies);
  EXPECT_EQ(welcome.array<std::int32_t>("boundary/body").size(), bodies);
}

TEST(Handshake, WatchersMayJoinAtAnyTimeAndInAnyNumber) {
  TestServer server(ball());
  Peer rigid(server.endpoint());
  ASSERT_TRUE(rigid.hello(RIGID).header.has_welcome());
  for (std::uint64_t step = 1; step <= 50; ++step) {
    Message message = kinematics(step, step, 1);
    rigid.send(message);
    ASSERT_TRUE(rigid.receive().header.has_wrenches());
  }
  Peer first(server.endpoint()), second(server.endpoint());
  EXPECT_TRUE(first.hello(WATCHER).header.has_welcome());
  EXPECT_TRUE(second.hello(WATCHER).header.has_welcome());
  EXPECT_NE(first.token(), second.token());
}

TEST(Handshake, RefusesAnotherVersionNamingBoth) {
  TestServer server(ball());
  Peer peer(server.endpoint());
  Message hello;
  hello.header.set_protocol_version(protocol::kProtocolVersion + 41);
  hello.header.mutable_hello()->set_role(RIGID);
  peer.send_raw(hello);

  const Message answer = peer.receive();
  EXPECT_EQ(answer.header.refusal().code(), Refusal::VERSION_MISMATCH);
  EXPECT_THAT(answer.header.refusal().reason(), HasSubstr(std::to_string(protocol::kProtocolVersion + 41)));
  EXPECT_THAT(answer.header.refusal().reason(), HasSubstr(std::to_string(protocol::kProtocolVersion)));
  EXPECT_EQ(answer.header.protocol_version(), protocol::kProtocolVersion);
}

TEST(Handshake, RefusesARoleThatIsTaken) {
  TestServer server(ball());
  Peer first(server.endpoint()), second(server.endpoint());
  ASSERT_TRUE(first.hello(RIGID).header.has_welcome());
  EXPECT_EQ(second.hello(RIGID).header.refusal().code(), Refusal::ROLE_TAKEN);
}

TEST(Handshake, GivesTheRoleOfOneWhoWentBeforeTheStartToTheNext) {
  TestServer server(ball(), with_recorder());  // without a recorder the run does not begin
  {
    Peer first(server.endpoint());
    ASSERT_TRUE(first.hello(RIGID).header.has_welcome());
    Message message = kinematics(1, 1, 1);
    first.send(message);
  }
  // The server learns that the first is gone a little later than the test.
  Peer second(server.endpoint());
  Message answer = second.hello(RIGID);
  while (answer.header.refusal().code() == Refusal::ROLE_TAKEN) answer = second.hello(RIGID);
  ASSERT_TRUE(answer.header.has_welcome());

  TestRecorder recorder(server.endpoint());
  Message message = kinematics(1, 1, 1);  // the count starts over
  second.send(message);
  EXPECT_TRUE(second.receive().header.has_wrenches());
}

TEST(Handshake, RefusesWhomTheRunDoesNotNeed) {
  TestServer no_bodies(tank(), with_recorder());
  Peer rigid(no_bodies.endpoint());
  EXPECT_EQ(rigid.hello(RIGID).header.refusal().code(), Refusal::NOT_NEEDED);

  TestServer no_recorder(ball());
  Peer recorder(no_recorder.endpoint());
  EXPECT_EQ(recorder.hello(RECORDER).header.refusal().code(), Refusal::NOT_NEEDED);
}

TEST(Handshake, RefusesARoleThatDoesNotExist) {
  TestServer server(ball());
  Peer peer(server.endpoint());
  EXPECT_EQ(peer.hello(ROLE_UNSPECIFIED).header.refusal().code(), Refusal::BAD_MESSAGE);
}

TEST(Handshake, RepeatsTheWelcomeOnTheSameConnection) {
  TestServer server(ball());
  Peer rigid(server.endpoint());
  rigid.hello(RIGID);
  const std::uint64_t token = rigid.token();
  EXPECT_TRUE(rigid.hello(RIGID).header.has_welcome());
  EXPECT_EQ(rigid.token(), token);
  EXPECT_EQ(rigid.hello(WATCHER).header.refusal().code(), Refusal::BAD_MESSAGE);
}

TEST(Tokens, AreNeededForEveryMessage) {
  TestServer server(ball());
  Peer stranger(server.endpoint());
  Message message = kinematics(1, 1, 1);
  stranger.send(message);
  EXPECT_EQ(stranger.receive().header.refusal().code(), Refusal::BAD_TOKEN);

  Peer wrong_token(server.endpoint());
  wrong_token.hello(RIGID);
  wrong_token.set_token(wrong_token.token() + 1);
  message = kinematics(1, 1, 1);
  wrong_token.send(message);
  EXPECT_EQ(wrong_token.receive().header.refusal().code(), Refusal::BAD_TOKEN);

  wrong_token.set_token(wrong_token.token() - 1);
  wrong_token.set_run_id("another run");
  message = kinematics(1, 1, 1);
  wrong_token.send(message);
  EXPECT_EQ(wrong_token.receive().header.refusal().code(), Refusal::BAD_TOKEN);
}

TEST(Tokens, OfOnePeerDoNotServeAnother) {
  TestServer server(ball());
  Peer rigid(server.endpoint()), thief(server.endpoint());
  const std::string run_id = rigid.hello(RIGID).header.run_id();
  thief.set_run_id(run_id);
  thief.set_token(rigid.token());
  Message message = kinematics(1, 1, 1);
  thief.send(message);
  EXPECT_EQ(thief.receive().header.refusal().code(), Refusal::BAD_TOKEN);
}

TEST(Garbage, IsDroppedAndTheRunGoesOn) {
  TestServer server(ball());
  Peer vandal(server.endpoint());
  for (const char* text : {"", "\xff\xff\xff", "not a header"}) {
    vandal.socket().send(zmq::str_buffer("frame"), zmq::send_flags::sndmore);
    vandal.socket().send(zmq::buffer(std::string(text)));
  }
  Peer rigid(server.endpoint());
  ASSERT_TRUE(rigid.hello(RIGID).header.has_welcome());
  play_rigid(rigid, server.steps(), 1, 1);
  EXPECT_EQ(server.outcome().reason, End::FINISHED);
}

TEST(Heartbeats, AreAnswered) {
  TestServer server(ball());
  Peer rigid(server.endpoint());
  rigid.hello(RIGID);
  constexpr int kCount = 50;
  for (int i = 0; i < kCount; ++i) {
    Message heartbeat;
    heartbeat.header.mutable_heartbeat();
    rigid.send(heartbeat);
  }
  // Messages are dealt with in order: all answers are here before the one to a message that is refused.
  Message refused = kinematics(7, 7, 1);
  rigid.send(refused);
  int heartbeats = 0;
  while (true) {
    const auto answer = protocol::receive_within(rigid.socket(), kPatience);
    ASSERT_TRUE(answer);
    if (answer->message.header.has_refusal()) break;
    heartbeats += answer->message.header.has_heartbeat();
  }
  EXPECT_GE(heartbeats, kCount);
}

TEST(Start, EndsTheRunWhenTheRigidProcessDoesNotJoin) {
  server::Options options;
  options.start_deadline = std::chrono::milliseconds(50);
  TestServer server(ball(), options);
  const server::Outcome outcome = server.outcome();
  EXPECT_EQ(outcome.reason, End::PARTICIPANT_TIMEOUT);
  EXPECT_THAT(outcome.detail, HasSubstr("rigid process did not join"));
}

TEST(Start, EndsTheRunWhenTheRecorderDoesNotJoin) {
  server::Options options = with_recorder();
  options.start_deadline = std::chrono::milliseconds(50);
  TestServer server(tank(), options);
  const server::Outcome outcome = server.outcome();
  EXPECT_EQ(outcome.reason, End::RECORDER_LOST);
  EXPECT_THAT(outcome.detail, HasSubstr("recorder did not join"));
}

TEST(Start, NeedsNobodyWithoutBodiesAndRecorder) {
  TestServer server(tank());
  const server::Outcome outcome = server.outcome();
  EXPECT_EQ(outcome.reason, End::FINISHED);
  EXPECT_EQ(outcome.steps, 100u);
}

}  // namespace
}  // namespace sluice::testing
