#include <gmock/gmock.h>

#include "tests/coupling/test_server.hpp"

namespace sluice::testing {
namespace {

using protocol::Message;
using ::testing::HasSubstr;

// Plays the rigid process in a thread until the run ends.
class RigidThread {
 public:
  explicit RigidThread(const TestServer& server)
      : wrenches_(std::async(std::launch::async, [endpoint = server.endpoint(), steps = server.steps()] {
          Peer peer(endpoint);
          peer.hello(RIGID);
          return play_rigid(peer, steps, 64, 2);
        })) {}
  std::vector<double> wrenches() { return wrenches_.get(); }

 private:
  std::future<std::vector<double>> wrenches_;
};

// The gate with an output after every step: more messages than may be unacknowledged.
Scene many_frames() {
  Scene scene = gate();
  scene.mutable_output()->set_rate(1000);
  return scene;
}

TEST(Recording, StreamsEverythingInOrder) {
  TestServer server(gate(), with_recorder());
  RigidThread rigid(server);
  TestRecorder recorder(server.endpoint());
  const std::vector<Message> messages = recorder.record();

  std::uint64_t logged = 0, frames = 0;
  std::vector<double> wrenches;
  for (std::size_t i = 0; i < messages.size(); ++i) {
    const Header& header = messages[i].header;
    EXPECT_EQ(header.sequence(), i + 1);
    EXPECT_EQ(header.run_id(), recorder.welcome().header.run_id());
    if (header.has_exchange_log()) {
      const ExchangeLog& log = header.exchange_log();
      EXPECT_EQ(log.first_step(), logged + 1);
      EXPECT_EQ(messages[i].shape("kinematics"), (std::vector<std::uint64_t>{log.count(), 1, 19}));
      EXPECT_EQ(messages[i].array<double>("kinematics")[0], static_cast<double>(log.first_step()));
      const auto rows = messages[i].array<double>("wrenches");
      wrenches.insert(wrenches.end(), rows.begin(), rows.end());
      logged += log.count();
      EXPECT_EQ(header.step(), logged);
    } else if (header.has_frame()) {
      EXPECT_EQ(header.frame().index(), frames++);
      EXPECT_EQ(header.step(), logged);  // the exchanges up to a frame come before it
      EXPECT_EQ(header.frame().hash(), messages[i].hash_arrays());
    }
  }
  EXPECT_EQ(frames, 11u);
  EXPECT_EQ(wrenches, rigid.wrenches());
  EXPECT_EQ(messages.back().header.end().reason(), End::FINISHED);
  EXPECT_EQ(server.outcome().reason, End::FINISHED);
}

TEST(Recording, LogsLongIntervalsInBatches) {
  Scene scene = gate();
  scene.set_duration(0.6);
  scene.mutable_output()->set_rate(1 / 0.6);
  TestServer server(scene, with_recorder());
  RigidThread rigid(server);
  TestRecorder recorder(server.endpoint());
  std::vector<std::uint32_t> counts;
  for (const Message& message : recorder.record()) {
    if (message.header.has_exchange_log()) counts.push_back(message.header.exchange_log().count());
  }
  EXPECT_EQ(counts, (std::vector<std::uint32_t>{256, 256, 88}));
}

TEST(Recording, WorksWithoutBodies) {
  TestServer server(tank(), with_recorder());
  TestRecorder recorder(server.endpoint());
  EXPECT_EQ(recorder.record().size(), 12u);  // 11 frames and the end
  EXPECT_EQ(server.outcome().reason, End::FINISHED);
}

TEST(BackPressure, HoldsTheRunUntilTheRecorderAcknowledges) {
  TestServer server(many_frames(), with_recorder());
  RigidThread rigid(server);
  TestRecorder recorder(server.endpoint());

  // Unacknowledged, exactly the window arrives and nothing more.
  std::uint64_t sequence = 0;
  for (; sequence < server::RecordStream::kMostMessages; ++sequence) {
    const auto message = recorder.pull();
    ASSERT_TRUE(message);
    ASSERT_EQ(message->header.sequence(), sequence + 1);
  }
  EXPECT_FALSE(recorder.pull(300));

  // One acknowledgement lets one message through.
  recorder.acknowledge(1);
  ASSERT_EQ(recorder.pull().value().header.sequence(), ++sequence);
  EXPECT_FALSE(recorder.pull(300));

  // And nothing was dropped.
  recorder.acknowledge(sequence);
  bool ended = false;
  while (!ended) {
    const auto message = recorder.pull();
    ASSERT_TRUE(message);
    ASSERT_EQ(message->header.sequence(), ++sequence);
    recorder.acknowledge(sequence);
    ended = message->header.has_end();
  }
  EXPECT_EQ(sequence, 101u + 100u + 1u);
  EXPECT_EQ(server.outcome().reason, End::FINISHED);
}

TEST(BackPressure, EndsTheRunOfARecorderThatNeverAcknowledges) {
  server::Options options = with_recorder();
  options.recorder_deadline = std::chrono::milliseconds(200);
  TestServer server(many_frames(), options);
  RigidThread rigid(server);
  TestRecorder recorder(server.endpoint());
  const server::Outcome outcome = server.outcome();
  EXPECT_EQ(outcome.reason, End::RECORDER_LOST);
  EXPECT_THAT(outcome.detail, HasSubstr("acknowledged nothing within 0.2 s"));
}

TEST(BackPressure, TheEndWaitsForTheLastAcknowledgement) {
  server::Options options = with_recorder();
  options.recorder_deadline = std::chrono::milliseconds(200);
  TestServer server(gate(), options);  // fits into the window: only the end has to wait
  RigidThread rigid(server);
  TestRecorder recorder(server.endpoint());
  EXPECT_EQ(server.outcome().reason, End::RECORDER_LOST);
}

TEST(Recording, EndsTheRunWhenTheRecorderLeaves) {
  TestServer server(many_frames(), with_recorder());
  RigidThread rigid(server);
  {
    TestRecorder recorder(server.endpoint());
    ASSERT_TRUE(recorder.pull());
  }
  EXPECT_EQ(server.outcome().reason, End::RECORDER_LOST);
}

TEST(Recording, RefusesAnAcknowledgementOfWhatWasNotSent) {
  TestServer server(many_frames(), with_recorder());
  RigidThread rigid(server);
  TestRecorder recorder(server.endpoint());
  ASSERT_TRUE(recorder.pull());
  recorder.acknowledge(1000);
  const Message answer = recorder.peer().receive();
  EXPECT_EQ(answer.header.refusal().code(), Refusal::BAD_SEQUENCE);
  recorder.record();
  EXPECT_EQ(server.outcome().reason, End::FINISHED);
}

TEST(Recording, AcknowledgementsNeedTheToken) {
  TestServer server(many_frames(), with_recorder());
  RigidThread rigid(server);
  TestRecorder recorder(server.endpoint());
  const std::uint64_t token = recorder.peer().token();
  recorder.peer().set_token(token + 1);
  recorder.acknowledge(1);
  EXPECT_EQ(recorder.peer().receive().header.refusal().code(), Refusal::BAD_TOKEN);
  recorder.peer().set_token(token);
  recorder.record();
  EXPECT_EQ(server.outcome().reason, End::FINISHED);
}

TEST(Guarding, AnUnstableRunEndsWithTheParticleNamedAndTheRecordComplete) {
  SolverScript script;
  script.spoil = [](std::uint64_t step, fluid::Snapshot& state) {
    if (step == 40) state.density[7] = 1600;
  };
  TestServer server(gate(), with_recorder(), script);
  RigidThread rigid(server);
  TestRecorder recorder(server.endpoint());
  const std::vector<Message> messages = recorder.record();

  const End& end = messages.back().header.end();
  EXPECT_EQ(end.reason(), End::UNSTABLE);
  EXPECT_THAT(end.detail(), HasSubstr("particle 7 at ("));
  EXPECT_THAT(end.detail(), HasSubstr("t = 0.04 s"));
  // Every step that was answered is in the record.
  const Header& last = messages[messages.size() - 2].header;
  EXPECT_EQ(last.exchange_log().first_step() + last.exchange_log().count(), 40u);
  EXPECT_EQ(server.outcome().reason, End::UNSTABLE);
}

}  // namespace
}  // namespace sluice::testing
