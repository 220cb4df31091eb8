#include "clients/recording/repair.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hdf5.h>

#include "protocol/error.hpp"
#include "tests/unit/clients/killed.hpp"

namespace sluice::clients::test {
namespace {

using protocol::InputError;
using std::chrono::microseconds;
using testing::AllOf;
using testing::HasSubstr;

class RepairTest : public testing::Test {
 protected:
  // A recorder that was killed after it had acknowledged some frames.
  std::uint64_t kill(std::uint64_t frames) const {
    return kill_after([&](int pipe) { record_aloud(run_, path_, pipe); }, frames, microseconds(0))
        .acknowledged;
  }
  [[nodiscard]] std::string refusal(const std::filesystem::path& output = {}) const {
    try {
      (void)repair(path_, output);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }
  void expect_frames(const std::filesystem::path& path, std::uint64_t least) const {
    const Reader recording(path);
    EXPECT_EQ(recording.ending(), Ending::kFinished);
    ASSERT_GE(recording.frames(), least);
    for (std::uint64_t index = 0; index < recording.frames(); ++index)
      expect_same(recording.frame(index), run_.frame(index));
  }

  const TemporaryDirectory directory_;
  const std::filesystem::path path_ = directory_ / "run.h5";
  const FakeRun run_{.frames = 300};
};

// Other programs open files as the library does by default.
bool opens_plainly(const std::filesystem::path& path) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  if (file >= 0) H5Fclose(file);
  return file >= 0;
}

TEST_F(RepairTest, MakesAKilledRecordingReadableForEveryone) {
  const std::uint64_t acknowledged = kill(20);
  ASSERT_FALSE(opens_plainly(path_));
  const std::string before = bytes_of(path_);
  const Repair done = repair(path_, {});
  EXPECT_TRUE(opens_plainly(path_));
  EXPECT_EQ(done.repaired, path_);
  EXPECT_EQ(done.kept, done.found);
  expect_frames(path_, acknowledged);
  EXPECT_EQ(Reader(path_).reason(), "recorder killed");
  EXPECT_EQ(done.original, directory_ / "run.damaged.h5");
  EXPECT_TRUE(bytes_of(done.original) == before);
  EXPECT_TRUE(std::filesystem::exists(directory_ / "run.xdmf"));
}

TEST_F(RepairTest, WritesElsewhereWhenAsked) {
  const std::uint64_t acknowledged = kill(5);
  const std::string before = bytes_of(path_);
  EXPECT_EQ(repair(path_, directory_ / "new.h5").repaired, directory_ / "new.h5");
  expect_frames(directory_ / "new.h5", acknowledged);
  EXPECT_TRUE(bytes_of(path_) == before);
}

TEST_F(RepairTest, LeavesAWholeRecordingAlone) {
  record(run_, path_);
  const std::string before = bytes_of(path_);
  EXPECT_TRUE(repair(path_, {}).repaired.empty());
  EXPECT_TRUE(bytes_of(path_) == before);
}

// A frame that is not what was written ends what can be trusted.
TEST_F(RepairTest, KeepsWhatIsBeforeTheDamage) {
  record(run_, path_);
  const protocol::Message frame = run_.frame(100);
  const auto values = frame.array<double>("fluid/position");
  std::string bytes = bytes_of(path_);
  const std::size_t at =
      bytes.find(std::string(reinterpret_cast<const char*>(values.data()), values.size_bytes()));
  ASSERT_NE(at, std::string::npos);
  bytes[at + 80] ^= 1;
  write_bytes(path_, bytes);
  const Repair done = repair(path_, {});
  EXPECT_EQ(done.kept.frames, 100u);
  EXPECT_EQ(done.found.frames, run_.frames + 1);
  EXPECT_EQ(Reader(path_).frames(), 100u);
  EXPECT_THAT(Reader(path_).detail(), HasSubstr("100 of 301 frames"));
}

TEST_F(RepairTest, RefusesWhatItCannotDo) {
  EXPECT_THAT(refusal(), HasSubstr("No such file"));
  write_bytes(path_, "text");
  EXPECT_THAT(refusal(), HasSubstr("not an HDF5 file"));
  std::filesystem::remove(path_);
  {
    Writer writer(OutputFile(path_, false), run_.welcome());
    EXPECT_THAT(refusal(), HasSubstr("being written"));
    writer.finish("FINISHED", "");
  }
  std::filesystem::remove(path_);
  kill(3);
  write_bytes(directory_ / "run.damaged.h5", "mine");
  EXPECT_THAT(refusal(), AllOf(HasSubstr("run.damaged.h5 exists already"), HasSubstr("-o")));
  EXPECT_EQ(bytes_of(directory_ / "run.damaged.h5"), "mine");
}

}  // namespace
}  // namespace sluice::clients::test
