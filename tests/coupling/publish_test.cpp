#include <gmock/gmock.h>

#include "tests/coupling/test_server.hpp"

namespace sluice::testing {
namespace {

using protocol::Message;

class Watcher {
 public:
  Watcher(const protocol::Endpoint& endpoint, std::initializer_list<std::string> topics) {
    socket_.connect(endpoint.publish);
    for (const std::string& topic : topics) socket_.set(zmq::sockopt::subscribe, topic);
  }
  protocol::Received receive() {
    auto received = protocol::receive_within(socket_, kPatience);
    if (!received) throw std::runtime_error("nothing was published");
    return std::move(*received);
  }
  Message receive(const std::string& topic) {
    while (true) {
      protocol::Received received = receive();
      if (received.identity == topic) return std::move(received.message);
    }
  }

 private:
  zmq::context_t context_;
  zmq::socket_t socket_ = protocol::make_socket(context_, zmq::socket_type::sub);
};

TEST(Publishing, SerialisesNothingWithoutSubscribers) {
  TestServer server(gate());
  Peer rigid(server.endpoint());
  rigid.hello(RIGID);
  play_rigid(rigid, server.steps(), 64, 2);
  const server::Outcome outcome = server.outcome();
  EXPECT_EQ(outcome.reason, End::FINISHED);
  EXPECT_EQ(outcome.frames_serialised, 0u);
  EXPECT_EQ(outcome.messages_serialised, 0u);
  EXPECT_EQ(outcome.bytes_serialised, 0u);
}

// What is counted are all messages for recorder and watchers.
TEST(Publishing, SerialisesForARecorderWhatItGets) {
  TestServer server(tank(), with_recorder());
  TestRecorder recorder(server.endpoint());
  const std::vector<Message> messages = recorder.record();
  const server::Outcome outcome = server.outcome();
  EXPECT_EQ(outcome.frames_serialised, 11u);
  EXPECT_EQ(outcome.messages_serialised, messages.size() - 1);  // but for the end
  EXPECT_GT(outcome.bytes_serialised, 11u * 50 * 8 * 8);
}

TEST(Publishing, SerialisesLessOfWhatIsSelected) {
  Scene scene = tank();
  scene.mutable_output()->set_particles_every(5);
  scene.mutable_output()->set_precision(FLOAT32);
  TestServer server(scene, with_recorder());
  TestRecorder recorder(server.endpoint());
  (void)recorder.record();
  EXPECT_LT(server.outcome().bytes_serialised, 3u * 50 * 8 * 4 + 11u * 500);
}

TEST(Publishing, ASubscriberToTheStatusCostsNoFrames) {
  TestServer server(gate());
  Watcher watcher(server.endpoint(), {"status"});
  watcher.receive("status");
  Peer rigid(server.endpoint());
  rigid.hello(RIGID);
  play_rigid(rigid, server.steps(), 64, 2);
  EXPECT_EQ(server.outcome().frames_serialised, 0u);
}

// Plays the ball's process up to the next output, the index-th; so the watcher never falls behind.
void step_to_output(Peer& rigid, std::uint64_t index) {
  for (std::uint64_t step = index == 0 ? 1 : 10 * index - 9; index > 0 && step <= 10 * index; ++step) {
    Message message = kinematics(step, step, 1);
    rigid.send(message);
    ASSERT_TRUE(rigid.receive().header.has_wrenches());
  }
}

TEST(Publishing, SendsEveryFrameToAWatcherThatKeepsUp) {
  TestServer server(ball());
  Watcher watcher(server.endpoint(), {"frame", "status"});
  watcher.receive("status");  // both subscriptions have arrived
  Peer rigid(server.endpoint());
  rigid.hello(RIGID);

  for (std::uint64_t index = 0; index <= 10; ++index) {
    step_to_output(rigid, index);
    const Message frame = watcher.receive("frame");
    EXPECT_EQ(frame.header.frame().index(), index);
    EXPECT_EQ(frame.header.step(), 10 * index);
    EXPECT_EQ(frame.header.time_ns(), static_cast<std::int64_t>(10'000'000 * index));
    EXPECT_EQ(frame.header.frame().hash(), frame.hash_arrays());
    EXPECT_EQ(frame.header.frame().energy().kinetic(), 10.0 * static_cast<double>(index));
  }
  EXPECT_EQ(server.outcome().frames_serialised, 11u);
}

TEST(Publishing, FramesHoldTheState) {
  TestServer server(ball());
  Watcher watcher(server.endpoint(), {"frame", "status"});
  watcher.receive("status");
  Peer rigid(server.endpoint());
  rigid.hello(RIGID);
  const Message frame = watcher.receive("frame");

  using Shape = std::vector<std::uint64_t>;
  EXPECT_EQ(frame.shape("fluid/position"), (Shape{50, 3}));
  EXPECT_EQ(frame.shape("fluid/velocity"), (Shape{50, 3}));
  EXPECT_EQ(frame.shape("fluid/density"), (Shape{50}));
  EXPECT_EQ(frame.shape("fluid/pressure"), (Shape{50}));
  EXPECT_EQ(frame.shape("body/kinematics"), (Shape{1, 19}));
  EXPECT_EQ(frame.shape("body/wrench"), (Shape{1, 6}));
  EXPECT_DOUBLE_EQ(frame.array<double>("fluid/position")[0], 0.05);
  EXPECT_EQ(frame.array<double>("body/kinematics")[1], 1.2);
  EXPECT_EQ(frame.array<double>("body/wrench")[2], 1);
}

TEST(Publishing, FramesHoldWhatTheSceneSelects) {
  Scene scene = ball();
  scene.mutable_output()->set_particles_every(2);
  scene.mutable_output()->add_field(DENSITY);
  scene.mutable_output()->set_precision(FLOAT32);
  TestServer server(scene);
  Watcher watcher(server.endpoint(), {"frame", "status"});
  watcher.receive("status");
  Peer rigid(server.endpoint());
  rigid.hello(RIGID);
  for (std::uint64_t index = 0; index <= 5; ++index) {
    step_to_output(rigid, index);
    const Message frame = watcher.receive("frame");
    ASSERT_EQ(frame.header.frame().index(), index);
    EXPECT_EQ(frame.has_array("fluid/position"), index % 2 == 0);
    EXPECT_EQ(frame.has_array("fluid/density"), index % 2 == 0);
    EXPECT_FALSE(frame.has_array("fluid/pressure"));
    EXPECT_TRUE(frame.has_array("body/kinematics"));
    if (index % 2 == 1) continue;
    EXPECT_EQ(frame.array<float>("fluid/density")[0], 1000);
  }
}

TEST(Publishing, TellsWatchersTheEnd) {
  TestServer server(ball());
  Watcher watcher(server.endpoint(), {"status"});
  const Message status = watcher.receive("status");
  EXPECT_EQ(status.header.status().steps(), 100u);
  server.interrupt();
  Message last = watcher.receive("status");
  while (!last.header.has_end()) last = watcher.receive("status");
  EXPECT_EQ(last.header.end().reason(), End::INTERRUPTED);
  EXPECT_FALSE(last.header.run_id().empty());
}

}  // namespace
}  // namespace sluice::testing
