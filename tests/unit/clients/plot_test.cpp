#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "tests/unit/clients/fake_run.hpp"

namespace sluice::clients::test {
namespace {

using testing::HasSubstr;

struct Ended {
  int code;
  std::string output;
};

// Runs a module of the package in the source tree under the system's Python.
Ended python(const std::string& module, const std::string& arguments) {
  const std::string command = "PYTHONDONTWRITEBYTECODE=1 PYTHONPATH=" SLUICE_SOURCE
                              "/clients/python /usr/bin/python3 -m sluice." +
                              module + " " + arguments + " 2>&1";
  FILE* pipe = popen(command.c_str(), "r");
  Ended ended{};
  char buffer[256];
  while (std::fgets(buffer, sizeof buffer, pipe) != nullptr) ended.output += buffer;
  ended.code = WEXITSTATUS(pclose(pipe));
  return ended;
}

Ended plot(const std::string& arguments) {
  return python("plot", arguments);
}

class PlotTest : public testing::Test {
 protected:
  void SetUp() override { record(FakeRun{.bodies = 2}, directory_ / "run.h5"); }
  void expect_picture(const std::string& arguments) {
    const std::string picture = directory_ / "picture.png";
    const Ended ended = plot((directory_ / "run.h5").string() + " -o " + picture + " " + arguments);
    EXPECT_EQ(ended.code, 0) << ended.output;
    EXPECT_EQ(bytes_of(picture).substr(1, 3), "PNG");
    std::filesystem::remove(picture);
  }
  const TemporaryDirectory directory_;
};

TEST_F(PlotTest, DrawsParticlesAtOneTimeAndAtSeveral) {
  expect_picture("");
  expect_picture("--times 0.01,0.05,0.1 --field velocity_x --front");
}

TEST_F(PlotTest, DrawsBodiesAndEnergies) {
  expect_picture("--bodies");
  expect_picture("--energy");
}

TEST_F(PlotTest, MoviesAndExportsAreMade) {
  const std::string run = directory_ / "run.h5", out = directory_ / "out";
  EXPECT_EQ(python("movie", run + " -o " + out + ".gif --every 10").code, 0);
  EXPECT_EQ(bytes_of(out + ".gif").substr(0, 3), "GIF");
  EXPECT_EQ(python("export", run + " --to vtk " + out).code, 0);
  EXPECT_TRUE(std::filesystem::exists(out + "/fluid.pvd"));
  EXPECT_TRUE(std::filesystem::exists(out + "/bodies_00020.vtp"));
  EXPECT_EQ(python("export", run + " --to csv " + out).code, 0);
  EXPECT_TRUE(std::filesystem::exists(out + "/body_body1.csv"));
}

TEST_F(PlotTest, ARecordingIsIdenticalToItsLikeAlone) {
  record(FakeRun{.bodies = 2}, directory_ / "again.h5");
  record(FakeRun{.bodies = 2, .frames = 12}, directory_ / "shorter.h5");
  const std::string run = directory_ / "run.h5";
  const Ended same = python("diff", run + " " + (directory_ / "again.h5").string());
  EXPECT_EQ(same.code, 0);
  EXPECT_THAT(same.output, HasSubstr("identical at 21 common times"));
  const Ended shorter = python("diff", run + " " + (directory_ / "shorter.h5").string());
  EXPECT_EQ(shorter.code, 0);
  EXPECT_THAT(shorter.output, HasSubstr("identical at 13 common times of 21 and 13"));
}

TEST_F(PlotTest, SaysInOneLineWhatIsWrong) {
  const std::string run = directory_ / "run.h5";
  write_bytes(directory_ / "text.h5", "no recording");
  const auto expect_error = [](const std::string& arguments, const std::string& text) {
    const Ended ended = plot(arguments);
    EXPECT_EQ(ended.code, 1);
    EXPECT_THAT(ended.output, HasSubstr(text));
    EXPECT_EQ(std::count(ended.output.begin(), ended.output.end(), '\n'), 1) << ended.output;
  };
  expect_error(directory_ / "absent.h5", "absent.h5 does not exist");
  expect_error(directory_ / "text.h5", "not an HDF5 file");
  expect_error(run + " --field colour", "no field 'colour'");
  expect_error(run + " --time 3", "time 3 s is not in");
  expect_error(run + " --frame 21", "no frame 21");
}

}  // namespace
}  // namespace sluice::clients::test
