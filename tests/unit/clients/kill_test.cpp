#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <csignal>
#include <random>

#include "clients/recording/reader.hpp"
#include "clients/recording/repair.hpp"
#include "clients/recording/writer.hpp"
#include "tests/unit/clients/fake_run.hpp"
#include "tests/unit/clients/killed.hpp"

namespace sluice::clients::test {
namespace {

using std::chrono::microseconds;

void expect_acknowledged_frames(const std::filesystem::path& path, const FakeRun& run,
                                std::uint64_t acknowledged) {
  const Reader recording(path);
  if (acknowledged == kFinished) {
    EXPECT_EQ(recording.ending(), Ending::kFinished);
    acknowledged = run.frames + 1;
  }
  ASSERT_GE(recording.frames(), acknowledged);
  for (std::uint64_t index = 0; index < recording.frames(); ++index) {
    expect_same(recording.frame(index), run.frame(index));
    if (index > 0)
      expect_same(recording.exchange_log((index - 1) * run.steps_per_frame + 1,
                                         static_cast<std::uint32_t>(run.steps_per_frame)),
                  run.exchange_log(index));
  }
}

TEST(Kill, EveryAcknowledgedFrameStaysReadable) {
  const TemporaryDirectory directory;
  const FakeRun run{.particles = 700, .bodies = 2, .steps_per_frame = 37, .frames = 60};
  const unsigned seed = std::random_device()();
  std::mt19937 random(seed);
  const char* asked = std::getenv("SLUICE_KILLS");
  const int kills = asked != nullptr ? std::atoi(asked) : 40;
  std::cout << "seed " << seed << ", " << kills << " kills\n";
  int unfinished = 0;
  for (int i = 0; i < kills; ++i) {
    const std::uint64_t frames = std::uniform_int_distribution<std::uint64_t>(0, run.frames + 1)(random);
    const microseconds delay(std::uniform_int_distribution<int>(0, 3000)(random));
    SCOPED_TRACE(testing::Message() << "seed " << seed << ", kill " << i << ": " << delay.count()
                                    << " us after frame " << frames);
    const auto path = directory / ("run" + std::to_string(i) + ".h5");
    const Killed killed = kill_after([&](int pipe) { record_aloud(run, path, pipe); }, frames, delay);
    unfinished += killed.acknowledged == kFinished ? 0 : 1;
    expect_acknowledged_frames(path, run, killed.acknowledged);
    repair(path, {});
    EXPECT_EQ(Reader(path).ending(), Ending::kFinished);
    expect_acknowledged_frames(path, run, killed.acknowledged);
    if (HasFailure()) return;
    for (const char* suffix : {".h5", ".damaged.h5", ".xdmf", ".xdmf.h5"})
      std::filesystem::remove(directory / ("run" + std::to_string(i) + suffix));
  }
  EXPECT_GT(unfinished, kills / 3) << "the kills came too late to say anything";
}

TEST(Kill, TellsThatTheRecordingWasCutShort) {
  const TemporaryDirectory directory;
  const auto path = directory / "run.h5";
  const FakeRun run{.frames = 1000};
  const Killed killed = kill_after([&](int pipe) { record_aloud(run, path, pipe); }, 5, microseconds(0));
  ASSERT_TRUE(WIFSIGNALED(killed.status));
  const Reader recording(path);
  EXPECT_EQ(recording.ending(), Ending::kCutShort);
  EXPECT_EQ(recording.reason(), "running");
}

TEST(Kill, ReadingDoesNotChangeTheFile) {
  const TemporaryDirectory directory;
  const auto path = directory / "run.h5";
  const FakeRun run{.frames = 1000};
  kill_after([&](int pipe) { record_aloud(run, path, pipe); }, 5, microseconds(0));
  const std::string before = bytes_of(path);
  (void)Reader(path).frame(0);
  EXPECT_EQ(bytes_of(path), before);
}

TEST(Kill, AFileOfAKilledRecorderCanBeReplaced) {
  const TemporaryDirectory directory;
  const auto path = directory / "run.h5";
  const FakeRun run;
  kill_after([&](int pipe) { record_aloud(run, path, pipe); }, 5, microseconds(0));
  Writer(OutputFile(path, true), run.welcome()).finish("FINISHED", "");
  EXPECT_EQ(Reader(path).ending(), Ending::kFinished);
}

// Files of killed recorders that then lost their end as well (a copy cut short, a full disk).
TEST(Kill, CutFilesOfKilledRecordersNeverGiveWrongFrames) {
  const TemporaryDirectory directory;
  const FakeRun run{.frames = 30};
  kill_after([&](int pipe) { record_aloud(run, directory / "run.h5", pipe); }, 20, microseconds(0));
  const std::string whole = bytes_of(directory / "run.h5");
  std::mt19937 random(20240603);
  for (int i = 0; i < 20; ++i) {
    const std::size_t length = std::uniform_int_distribution<std::size_t>(1, whole.size() - 1)(random);
    SCOPED_TRACE(length);
    write_bytes(directory / "cut.h5", whole.substr(0, length));
    try {
      const Reader recording(directory / "cut.h5");
      for (std::uint64_t index = 0; index < recording.frames(); ++index)
        expect_same(recording.frame(index), run.frame(index));
    } catch (const protocol::InputError&) {
    }
  }
}

// A limit on the file's size stands for a full disk.
TEST(Kill, AFullDiskEndsTheRecordingAndKeepsWhatWasAcknowledged) {
  const TemporaryDirectory directory;
  const auto path = directory / "run.h5";
  const FakeRun run{.particles = 700, .frames = 1000};
  const auto record_until_full = [&](int pipe) {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{1 << 20, 1 << 20};
    setrlimit(RLIMIT_FSIZE, &limit);
    record_aloud(run, path, pipe);
  };
  const Killed ended = kill_after(record_until_full, kFinished, microseconds(0));
  ASSERT_TRUE(WIFEXITED(ended.status) && WEXITSTATUS(ended.status) == 3) << "the writer must throw";
  EXPECT_GT(ended.acknowledged, 3);
  expect_acknowledged_frames(path, run, ended.acknowledged);
}

}  // namespace
}  // namespace sluice::clients::test
