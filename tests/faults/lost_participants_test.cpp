// The real server with participants that die, stop or hang in mid-run.
#include <gmock/gmock.h>

#include "tests/coupling/directory.hpp"
#include "tests/faults/participants.hpp"
#include "tests/faults/scene_files.hpp"

namespace sluice::testing {
namespace {

using std::chrono::seconds;
using ::testing::HasSubstr;
using ::testing::MatchesRegex;

// What the server promises: from a loss to its end.
constexpr seconds kPromise{5};
constexpr seconds kStart{60};

class LostParticipants : public ::testing::Test {
 protected:
  void start_server(const std::string& scene, std::vector<std::string> options = {}) {
    const std::string file = write_file(directory_.path() / "test.scene", scene);
    options.insert(options.begin(), {"--scene", file, "--listen", directory_.endpoint(), "--threads", "1"});
    server_.emplace("sluice-server", options, directory_.path() / "server.log");
  }
  void start_rigid(std::uint32_t count, std::uint64_t ahead, bool hang = false) {
    rigid_.emplace([=, this] { rigid_child(endpoint(), count, ahead, rigid_mid_run_, hang); });
  }
  void start_recorder(bool hang = false) {
    recorder_.emplace([=, this] { recorder_child(endpoint(), recorder_mid_run_, hang); });
  }
  void expect_end(int code, const std::string& status) {
    const std::optional<int> exit = server_->wait(kPromise);
    ASSERT_TRUE(exit) << "the server still runs; it said:\n" << server_->log();
    EXPECT_EQ(*exit, code) << server_->log();
    // The status is the last line.
    EXPECT_THAT(server_->log(), MatchesRegex("(.*\n)*\\[sluice-server\\] status: " + status + " - [^\n]*\n"));
  }
  [[nodiscard]] protocol::Endpoint endpoint() const {
    return protocol::Endpoint::parse(directory_.endpoint());
  }

  Directory directory_;
  Signal rigid_mid_run_, recorder_mid_run_;
  std::optional<Child> server_, rigid_, recorder_;
};

TEST_F(LostParticipants, RigidProcessKilledInLockStep) {
  start_server(kEndlessTank + kFreeBall);
  start_rigid(1, 1);
  ASSERT_TRUE(rigid_mid_run_.wait(kStart));
  rigid_->signal(SIGKILL);
  expect_end(2, "PARTICIPANT_LOST");
}

TEST_F(LostParticipants, RigidProcessKilledWhileStreaming) {
  start_server(kEndlessTank + kPrescribedGate);
  start_rigid(64, 2);
  ASSERT_TRUE(rigid_mid_run_.wait(kStart));
  rigid_->signal(SIGKILL);
  expect_end(2, "PARTICIPANT_LOST");
}

TEST_F(LostParticipants, RigidProcessStoppedInLockStep) {
  start_server(kEndlessTank + kFreeBall);
  start_rigid(1, 1);
  ASSERT_TRUE(rigid_mid_run_.wait(kStart));
  rigid_->signal(SIGSTOP);
  expect_end(2, "(PARTICIPANT_LOST|PARTICIPANT_TIMEOUT)");
}

TEST_F(LostParticipants, RigidProcessStoppedWhileStreaming) {
  start_server(kEndlessTank + kPrescribedGate);
  start_rigid(64, 2);
  ASSERT_TRUE(rigid_mid_run_.wait(kStart));
  rigid_->signal(SIGSTOP);
  expect_end(2, "(PARTICIPANT_LOST|PARTICIPANT_TIMEOUT)");
}

TEST_F(LostParticipants, RigidProcessThatHangsButLives) {
  start_server(kEndlessTank + kFreeBall);
  start_rigid(1, 1, /*hang=*/true);
  ASSERT_TRUE(rigid_mid_run_.wait(kStart));
  expect_end(2, "PARTICIPANT_TIMEOUT");
  EXPECT_THAT(server_->log(), HasSubstr("no kinematics of step 21 within 4 s"));
}

TEST_F(LostParticipants, RecorderKilled) {
  start_server(kEndlessTank, {"--expect-recorder"});
  start_recorder();
  ASSERT_TRUE(recorder_mid_run_.wait(kStart));
  recorder_->signal(SIGKILL);
  expect_end(2, "RECORDER_LOST");
}

TEST_F(LostParticipants, RecorderStopped) {
  start_server(kEndlessTank, {"--expect-recorder"});
  start_recorder();
  ASSERT_TRUE(recorder_mid_run_.wait(kStart));
  recorder_->signal(SIGSTOP);
  expect_end(2, "RECORDER_LOST");
}

TEST_F(LostParticipants, RecorderThatHangsButLives) {
  start_server(kEndlessTank, {"--expect-recorder", "--recorder-deadline", "1"});
  start_recorder(/*hang=*/true);
  ASSERT_TRUE(recorder_mid_run_.wait(kStart));
  expect_end(2, "RECORDER_LOST");
}

TEST_F(LostParticipants, RecorderKilledIsToldToTheRigidProcess) {
  start_server(kEndlessTank + kFreeBall, {"--expect-recorder"});
  start_recorder();
  start_rigid(1, 1);
  ASSERT_TRUE(recorder_mid_run_.wait(kStart));
  recorder_->signal(SIGKILL);
  expect_end(2, "RECORDER_LOST");
  EXPECT_EQ(rigid_->wait(kPromise), 0);  // it got the End
}

TEST_F(LostParticipants, NobodyJoins) {
  start_server(kEndlessTank + kFreeBall, {"--start-deadline", "0.2"});
  expect_end(2, "PARTICIPANT_TIMEOUT");
}

TEST_F(LostParticipants, ASignalEndsTheServerInGoodOrder) {
  for (const int number : {SIGINT, SIGTERM}) {
    start_server(kEndlessTank, {"--expect-recorder"});
    Signal mid_run;
    Child recorder([&] { recorder_child(endpoint(), mid_run, false); });
    ASSERT_TRUE(mid_run.wait(kStart));
    server_->signal(number);
    expect_end(2, "INTERRUPTED");
    EXPECT_EQ(recorder.wait(kPromise), 0);  // it got the End
    EXPECT_FALSE(std::filesystem::exists(directory_.path() / "server"));
  }
}

}  // namespace
}  // namespace sluice::testing
