#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hdf5.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <random>

#include "clients/recording/layout.hpp"
#include "clients/recording/reader.hpp"
#include "clients/recording/writer.hpp"
#include "tests/unit/clients/fake_run.hpp"

namespace sluice::clients::test {
namespace {

using protocol::InputError;
using testing::AllOf;
using testing::HasSubstr;

// The message of the InputError that opening the file gives; empty when it opens.
std::string refusal(const std::filesystem::path& path) {
  testing::internal::CaptureStderr();
  std::string text;
  try {
    const Reader recording(path);
  } catch (const InputError& error) {
    text = error.what();
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "") << "only the error may say something";
  return text;
}

TEST(BadFile, IsNamedWithTheReason) {
  const TemporaryDirectory directory;
  EXPECT_THAT(refusal(directory / "absent.h5"), AllOf(HasSubstr("absent.h5"), HasSubstr("No such file")));
  EXPECT_THAT(refusal(directory / ""), HasSubstr("not a regular file"));
  write_bytes(directory / "empty.h5", "");
  EXPECT_THAT(refusal(directory / "empty.h5"), HasSubstr("is empty"));
  write_bytes(directory / "text.h5", "name: \"rising_gate\"\ndimension: 2\n");
  EXPECT_THAT(refusal(directory / "text.h5"), HasSubstr("not an HDF5 file"));
  write_bytes(directory / "short.h5", "\x89HDF");
  EXPECT_THAT(refusal(directory / "short.h5"), HasSubstr("not an HDF5 file"));
}

void make_foreign(const std::filesystem::path& path, H5F_libver_t version) {
  const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
  H5Pset_libver_bounds(access, version, H5F_LIBVER_LATEST);
  const hid_t file = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access);
  H5Gclose(H5Gcreate2(file, "/h5md", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
  H5Fclose(file);
  H5Pclose(access);
}

TEST(BadFile, ForeignHdf5IsNoRecording) {
  const TemporaryDirectory directory;
  make_foreign(directory / "old.h5", H5F_LIBVER_EARLIEST);
  EXPECT_THAT(refusal(directory / "old.h5"), HasSubstr("not a recording of sluice"));
  make_foreign(directory / "new.h5", H5F_LIBVER_LATEST);
  EXPECT_THAT(refusal(directory / "new.h5"), HasSubstr("not a recording of sluice"));
}

TEST(BadFile, NewerFormatIsRefusedByItsNumber) {
  const TemporaryDirectory directory;
  record({.frames = 1}, directory / "run.h5");
  const hid_t file = H5Fopen((directory / "run.h5").c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  const hid_t parameters = H5Gopen2(file, "/parameters", H5P_DEFAULT);
  const hid_t format = H5Aopen(parameters, "format", H5P_DEFAULT);
  const int newer = layout::kFormat + 1;
  H5Awrite(format, H5T_NATIVE_INT, &newer);
  H5Aclose(format);
  H5Gclose(parameters);
  H5Fclose(file);
  EXPECT_THAT(refusal(directory / "run.h5"), AllOf(HasSubstr("format 4"), HasSubstr("reads format 1 to 3")));
}

TEST(BadFile, CutAtAnyPlaceIsRefused) {
  const TemporaryDirectory directory;
  record({}, directory / "whole.h5");
  const std::string whole = bytes_of(directory / "whole.h5");
  std::mt19937 random(20240601);
  for (int i = 0; i < 20; ++i) {
    const std::size_t length = std::uniform_int_distribution<std::size_t>(1, whole.size() - 1)(random);
    SCOPED_TRACE(length);
    write_bytes(directory / "cut.h5", whole.substr(0, length));
    EXPECT_THAT(refusal(directory / "cut.h5"), HasSubstr("cut.h5"));
  }
}

// Reads all there is; false when something was refused. Anything that reads must be what was recorded.
bool reads_all(const std::filesystem::path& path, const FakeRun& run) {
  try {
    const Reader recording(path);
    for (std::uint64_t index = 0; index < recording.frames(); ++index) {
      const protocol::Message frame = recording.frame(index);
      const protocol::Message expected = run.frame(index);
      for (std::size_t i = 0; i < frame.frames.size(); ++i) EXPECT_EQ(frame.frames[i], expected.frames[i]);
    }
    (void)recording.welcome_message();
    if (recording.exchanges() > 0)
      (void)recording.exchange_log(1, static_cast<std::uint32_t>(recording.exchanges()));
    return recording.frames() == run.frames + 1;
  } catch (const InputError&) {
    return false;
  }
}

TEST(BadFile, FlippedBitsNeverCrashNorAlterAFrame) {
  const TemporaryDirectory directory;
  const FakeRun run{.frames = 4};
  record(run, directory / "whole.h5");
  const std::string whole = bytes_of(directory / "whole.h5");
  ASSERT_TRUE(reads_all(directory / "whole.h5", run));
  std::mt19937 random(20240602);
  int refused = 0;
  for (int i = 0; i < 300; ++i) {
    std::string flipped = whole;
    const std::size_t at = std::uniform_int_distribution<std::size_t>(0, whole.size() - 1)(random);
    flipped[at] = static_cast<char>(flipped[at] ^ (1 << (i % 8)));
    SCOPED_TRACE(testing::Message() << "byte " << at << ", bit " << i % 8);
    write_bytes(directory / "flipped.h5", flipped);
    refused += reads_all(directory / "flipped.h5", run) ? 0 : 1;
  }
  EXPECT_GT(refused, 0);
}

std::string output_refusal(const std::filesystem::path& path, bool force) {
  try {
    const OutputFile output(path, force);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(OutputFile, LeavesAnExistingFileAlone) {
  const TemporaryDirectory directory;
  write_bytes(directory / "notes.h5", "mine");
  EXPECT_THAT(output_refusal(directory / "notes.h5", false),
              AllOf(HasSubstr("exists already"), HasSubstr("--force")));
  { const OutputFile never_written(directory / "notes.h5", true); }
  EXPECT_EQ(bytes_of(directory / "notes.h5"), "mine");
  Writer(OutputFile(directory / "notes.h5", true), FakeRun{}.welcome()).finish("FINISHED", "");
  EXPECT_EQ(refusal(directory / "notes.h5"), "");
}

TEST(OutputFile, GoesAgainWhenNothingIsRecorded) {
  const TemporaryDirectory directory;
  { const OutputFile output(directory / "run.h5", false); }
  EXPECT_FALSE(std::filesystem::exists(directory / "run.h5"));
  EXPECT_THROW(Writer(OutputFile(directory / "run.h5", false), FakeRun{}.frame(0)), protocol::ProtocolError);
  EXPECT_FALSE(std::filesystem::exists(directory / "run.h5"));
}

TEST(OutputFile, NamesWhyItCannotBeWritten) {
  const TemporaryDirectory directory;
  EXPECT_THAT(output_refusal(directory / "no/run.h5", false),
              AllOf(HasSubstr("no/run.h5"), HasSubstr("No such file")));
  EXPECT_THAT(output_refusal(directory / "", true), HasSubstr("directory"));
  EXPECT_THAT(output_refusal("/dev/null", true), HasSubstr("not a regular file"));
}

TEST(OutputFile, RefusesAFileThatIsBeingWritten) {
  const TemporaryDirectory directory;
  Writer writer(OutputFile(directory / "run.h5", false), FakeRun{}.welcome());
  EXPECT_THAT(output_refusal(directory / "run.h5", true), HasSubstr("being written"));
  writer.write(FakeRun{}.frame(0));
  writer.finish("FINISHED", "");
}

// Root may write anywhere, so the attempt is made as nobody.
TEST(OutputFile, RefusesADirectoryWithoutPermission) {
  const TemporaryDirectory directory;
  std::filesystem::create_directory(directory / "locked");
  std::filesystem::permissions(directory / "locked",
                               std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
  std::filesystem::permissions(directory / "", static_cast<std::filesystem::perms>(0755));
  const pid_t child = fork();
  if (child == 0) {
    if (geteuid() == 0 && (setegid(65534) != 0 || seteuid(65534) != 0)) _exit(2);
    const std::string text = output_refusal(directory / "locked/run.h5", false);
    _exit(text.find("Permission denied") != std::string::npos ? 0 : 1);
  }
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_EQ(status, 0);
}

}  // namespace
}  // namespace sluice::clients::test
