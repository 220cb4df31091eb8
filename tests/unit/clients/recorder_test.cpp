#include "clients/record/recorder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <future>

#include "clients/recording/reader.hpp"
#include "tests/unit/clients/fake_run.hpp"
#include "tests/unit/clients/fake_server.hpp"

namespace sluice::clients::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class RecorderTest : public testing::Test {
 protected:
  // The recorder in a thread of its own, as it runs in its program.
  std::future<RecordOutcome> start() {
    return std::async(std::launch::async, [this] { return record(options_, stop_); });
  }
  void welcome(std::uint64_t done = 0) {
    const protocol::Message hello = server_.receive();
    EXPECT_EQ(hello.header.hello().role(), RECORDER);
    protocol::Message welcome = run_.welcome();
    welcome.header.mutable_welcome()->set_done(done);
    server_.reply(std::move(welcome));
  }
  void push_frames(std::uint64_t first, std::uint64_t last) {
    for (std::uint64_t index = first; index <= last; ++index) {
      if (index > 0) server_.push(run_.exchange_log(index));
      server_.push(run_.frame(index));
    }
  }
  [[nodiscard]] protocol::Message end(End::Reason reason) const {
    protocol::Message message;
    message.header.set_run_id("fake-run");
    message.header.mutable_end()->set_reason(reason);
    message.header.mutable_end()->set_detail("so it was");
    return message;
  }

  const TemporaryDirectory directory_;
  const FakeRun run_{};
  FakeServer server_{"ipc://" + (directory_ / "server").string()};
  RecordOptions options_{.endpoint = "ipc://" + (directory_ / "server").string(),
                         .output = directory_ / "run.h5",
                         .force = false,
                         .keys = {}};
  std::atomic<bool> stop_{false};
};

TEST_F(RecorderTest, RecordsToTheEndAndAcknowledgesAll) {
  auto outcome = start();
  welcome();
  push_frames(0, run_.frames);
  server_.push(end(End::FINISHED));
  server_.await_acknowledgement(server_.pushed());
  EXPECT_TRUE(outcome.get().complete);
  const Reader recording(directory_ / "run.h5");
  EXPECT_EQ(recording.reason(), "FINISHED");
  EXPECT_EQ(recording.detail(), "so it was");
  ASSERT_EQ(recording.frames(), run_.frames + 1);
  expect_same(recording.frame(run_.frames), run_.frame(run_.frames));
}

TEST_F(RecorderTest, WhatIsAcknowledgedCanBeReadAtOnce) {
  auto outcome = start();
  welcome();
  for (std::uint64_t index = 0; index < 5; ++index) {
    push_frames(index, index);
    server_.await_acknowledgement(server_.pushed());
    EXPECT_EQ(Reader(directory_ / "run.h5").frames(), index + 1);
  }
  server_.push(end(End::UNSTABLE));
  server_.await_acknowledgement(server_.pushed());
  EXPECT_EQ(outcome.get().reason, "UNSTABLE");
}

TEST_F(RecorderTest, FinishesTheFileWhenTheServerIsLost) {
  auto outcome = start();
  welcome();
  push_frames(0, 3);
  server_.await_acknowledgement(server_.pushed());
  server_.vanish();
  const RecordOutcome how = outcome.get();
  EXPECT_FALSE(how.complete);
  EXPECT_EQ(how.reason, "server lost");
  const Reader recording(directory_ / "run.h5");
  EXPECT_EQ(recording.ending(), Ending::kFinished);
  EXPECT_EQ(recording.reason(), "server lost");
  EXPECT_EQ(recording.frames(), 4);
}

TEST_F(RecorderTest, FinishesTheFileWhenAskedToStop) {
  auto outcome = start();
  welcome();
  push_frames(0, 1);
  server_.await_acknowledgement(server_.pushed());
  stop_ = true;
  EXPECT_EQ(outcome.get().reason, "interrupted");
  EXPECT_EQ(Reader(directory_ / "run.h5").frames(), 2);
}

TEST_F(RecorderTest, FinishesTheFileWhenTheStreamBreaksTheProtocol) {
  auto outcome = start();
  welcome();
  push_frames(0, 1);
  server_.push(run_.frame(7));
  const RecordOutcome how = outcome.get();
  EXPECT_EQ(how.reason, "protocol error");
  EXPECT_THAT(how.detail, HasSubstr("frame 7"));
  EXPECT_EQ(Reader(directory_ / "run.h5").frames(), 2);
}

// The frames after the checkpoint are recorded again, and none twice.
TEST_F(RecorderTest, GoesOnWithTheRecordingOfAResumedRun) {
  record(run_, directory_ / "run.h5");
  options_.resume = options_.output;
  auto outcome = start();
  welcome(4 * run_.steps_per_frame);
  push_frames(5, 6);
  server_.push(end(End::FINISHED));
  server_.await_acknowledgement(server_.pushed());
  EXPECT_TRUE(outcome.get().complete);
  const Reader recording(directory_ / "run.h5");
  EXPECT_EQ(recording.welcome().done(), 0u);
  ASSERT_EQ(recording.frames(), 7u);
  for (std::uint64_t index = 0; index < 7; ++index) expect_same(recording.frame(index), run_.frame(index));
  EXPECT_EQ(recording.exchanges(), 6 * run_.steps_per_frame);
}

// As long as nothing has come of the resumed run, the recording so far stays where it is.
TEST_F(RecorderTest, KeepsTheRecordingOfARunThatDoesNotGoOn) {
  record(run_, directory_ / "run.h5");
  const std::string before = bytes_of(directory_ / "run.h5");
  options_.resume = options_.output;
  auto outcome = start();
  welcome(4 * run_.steps_per_frame);
  server_.push(end(End::PARTICIPANT_TIMEOUT));
  EXPECT_EQ(outcome.get().reason, "PARTICIPANT_TIMEOUT");
  EXPECT_TRUE(bytes_of(directory_ / "run.h5") == before);
  EXPECT_FALSE(std::filesystem::exists(directory_ / "run.h5.resumed"));
}

TEST_F(RecorderTest, RefusesARecordingThatEndsBefore) {
  record({.frames = 3}, directory_ / "run.h5");
  options_.resume = options_.output;
  auto outcome = start();
  welcome(4 * run_.steps_per_frame);
  EXPECT_THAT([&] { outcome.get(); },
              testing::ThrowsMessage<protocol::InputError>(HasSubstr("holds 4 frames")));
}

TEST_F(RecorderTest, AsksForTheRecordingOfAResumedRun) {
  auto outcome = start();
  welcome(4 * run_.steps_per_frame);
  EXPECT_THAT([&] { outcome.get(); }, testing::ThrowsMessage<protocol::InputError>(HasSubstr("--resume")));
  EXPECT_FALSE(std::filesystem::exists(directory_ / "run.h5"));
}

TEST_F(RecorderTest, LeavesNothingWhenItIsRefused) {
  auto outcome = start();
  server_.receive();
  protocol::Message refusal;
  refusal.header.mutable_refusal()->set_code(Refusal::VERSION_MISMATCH);
  refusal.header.mutable_refusal()->set_reason("protocol version 1 is not 2");
  server_.reply(std::move(refusal));
  try {
    outcome.get();
    FAIL();
  } catch (const protocol::ProtocolError& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("VERSION_MISMATCH"), HasSubstr("protocol version 1 is not 2")));
  }
  EXPECT_FALSE(std::filesystem::exists(directory_ / "run.h5"));
}

TEST_F(RecorderTest, LeavesNothingWhenNoServerAnswers) {
  options_.endpoint = "ipc://" + (directory_ / "nobody").string();
  options_.patience = std::chrono::milliseconds(1);
  try {
    record(options_, stop_);
    FAIL();
  } catch (const protocol::PeerLost& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("nobody"), HasSubstr("is a server running there?")));
  }
  EXPECT_FALSE(std::filesystem::exists(directory_ / "run.h5"));
}

// An occupied name is found before the server hears of the recorder, and with --force the old file stays as
// long as there is nothing to put in its place.
TEST_F(RecorderTest, KeepsAnExistingFile) {
  write_bytes(directory_ / "run.h5", "mine");
  EXPECT_THROW(record(options_, stop_), protocol::InputError);
  options_.force = true;
  options_.endpoint = "ipc://" + (directory_ / "nobody").string();
  options_.patience = std::chrono::milliseconds(1);
  EXPECT_THROW(record(options_, stop_), protocol::PeerLost);
  EXPECT_EQ(bytes_of(directory_ / "run.h5"), "mine");
}

}  // namespace
}  // namespace sluice::clients::test
