// The real programs of a run, one of them killed or stopped in the middle: what the others do, and what the
// recording holds.
#include <gmock/gmock.h>

#include <regex>

#include "clients/recording/reader.hpp"
#include "tests/coupling/directory.hpp"
#include "tests/coupling/peer.hpp"
#include "tests/faults/child.hpp"
#include "tests/faults/scene_files.hpp"

namespace sluice::testing {
namespace {

using std::chrono::seconds;
using ::testing::HasSubstr;

constexpr seconds kPromise{5};      // of the server, from a loss to its end
constexpr seconds kServerGone{15};  // of a participant that hears nothing for 10 s

class KilledPrograms : public ::testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    const std::string scene = write_file(directory_.path() / "test.scene", kEndlessTank + GetParam());
    start(server_, "sluice-server",
          {"--scene", scene, "--listen", directory_.endpoint(), "--threads", "1", "--expect-recorder"});
    start(rigid_, "sluice-rigid", {"--connect", directory_.endpoint()});
    start(recorder_, "sluice-record", {"--connect", directory_.endpoint(), "-o", recording()});
    wait_for_mid_run();
  }

  void start(std::optional<Child>& child, const std::string& program,
             const std::vector<std::string>& arguments) {
    child.emplace(program, arguments, directory_.path() / (program + ".log"));
  }

  // Follows the status until some frames are behind.
  void wait_for_mid_run() {
    zmq::context_t context;
    zmq::socket_t status = protocol::make_socket(context, zmq::socket_type::sub);
    status.connect(protocol::Endpoint::parse(directory_.endpoint()).publish);
    status.set(zmq::sockopt::subscribe, "status");
    while (auto received = protocol::receive_within(status, kPatience)) {
      ASSERT_FALSE(received->message.header.has_end()) << server_->log();
      if (received->message.header.step() > 100) return;
    }
    FAIL() << "no status came; the server said:\n" << server_->log();
  }

  void expect_exit(std::optional<Child>& child, int code, seconds time) {
    const std::optional<int> exit = child->wait(time);
    ASSERT_TRUE(exit) << "still runs; it said:\n" << child->log();
    EXPECT_EQ(*exit, code) << child->log();
  }

  // Every frame and every exchange up to the last frame can be read, bit for bit.
  static void expect_sound(const clients::Reader& reader) {
    ASSERT_GT(reader.frames(), 0u);
    for (std::uint64_t i = 0; i < reader.frames(); ++i) {
      const protocol::Message frame = reader.frame(i);
      EXPECT_EQ(frame.header.frame().index(), i);
      EXPECT_EQ(frame.header.frame().hash(), frame.hash_arrays());
    }
    EXPECT_GE(reader.exchanges(), reader.frame_header(reader.frames() - 1).step());
  }

  [[nodiscard]] std::string recording() const { return directory_.path() / "run.h5"; }

  Directory directory_;
  std::optional<Child> server_, rigid_, recorder_;
};

INSTANTIATE_TEST_SUITE_P(Bodies, KilledPrograms, ::testing::Values(kFreeBall, kPrescribedGate),
                         [](const auto& test) { return test.index == 0 ? "Free" : "Prescribed"; });

TEST_P(KilledPrograms, TheRecorderLeavesEveryAcknowledgedFrame) {
  recorder_->signal(SIGKILL);
  expect_exit(server_, 2, kPromise);
  expect_exit(rigid_, 2, kPromise);

  const std::string log = server_->log();
  EXPECT_THAT(log, HasSubstr("status: RECORDER_LOST - "));
  std::smatch match;
  ASSERT_TRUE(std::regex_search(log, match, std::regex("; (\\d+) messages up to step (\\d+) are recorded")))
      << log;
  const std::uint64_t messages = std::stoull(match[1]), step = std::stoull(match[2]);
  ASSERT_GT(messages, 1u);

  const clients::Reader reader(recording());
  EXPECT_EQ(reader.ending(), clients::Ending::kCutShort);
  expect_sound(reader);
  // The first frame alone, then a log and a frame for every output: this scene has fewer than 256 steps
  // between.
  EXPECT_LE(reader.welcome().steps_per_interval(), 256u);
  EXPECT_GE(reader.frames(), 1 + (messages - 1) / 2);
  EXPECT_GE(reader.exchanges(), step);
}

TEST_P(KilledPrograms, TheRigidProcessLeavesACompleteRecord) {
  rigid_->signal(SIGKILL);
  expect_exit(server_, 2, kPromise);
  EXPECT_THAT(server_->log(), HasSubstr("status: PARTICIPANT_LOST - "));
  expect_exit(recorder_, 0, kPromise);

  const clients::Reader reader(recording());
  EXPECT_EQ(reader.ending(), clients::Ending::kFinished);
  EXPECT_EQ(reader.reason(), "PARTICIPANT_LOST");
  expect_sound(reader);
}

TEST_P(KilledPrograms, TheRigidProcessStopped) {
  rigid_->signal(SIGSTOP);
  expect_exit(server_, 2, kPromise);
  EXPECT_THAT(server_->log(), ::testing::ContainsRegex("status: PARTICIPANT_(LOST|TIMEOUT) - "));
  expect_exit(recorder_, 0, kPromise);
  EXPECT_EQ(clients::Reader(recording()).ending(), clients::Ending::kFinished);
}

TEST_P(KilledPrograms, TheServerIsMissedByEveryone) {
  server_->signal(SIGKILL);
  expect_exit(rigid_, 2, kServerGone);
  expect_exit(recorder_, 2, kServerGone);

  const clients::Reader reader(recording());
  EXPECT_EQ(reader.ending(), clients::Ending::kFinished);
  EXPECT_EQ(reader.reason(), "server lost");
  expect_sound(reader);
}

TEST_P(KilledPrograms, AnInterruptedServerEndsEveryoneInGoodOrder) {
  server_->signal(SIGINT);
  expect_exit(server_, 2, kPromise);
  expect_exit(rigid_, 2, kPromise);
  expect_exit(recorder_, 0, kPromise);
  EXPECT_EQ(clients::Reader(recording()).reason(), "INTERRUPTED");
}

}  // namespace
}  // namespace sluice::testing
