#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hdf5.h>

#include "clients/recording/archive.hpp"
#include "clients/recording/inspect.hpp"
#include "clients/recording/reader.hpp"
#include "clients/recording/size.hpp"
#include "clients/recording/writer.hpp"
#include "tests/unit/clients/fake_run.hpp"

namespace sluice::clients::test {
namespace {

using protocol::ProtocolError;
using testing::HasSubstr;

void expect_reads_back(const Reader& recording, const FakeRun& run, std::uint64_t frames) {
  expect_same(recording.welcome_message(), run.welcome());
  for (std::uint64_t index = 0; index < frames; ++index) {
    expect_same(recording.frame(index), run.frame(index));
    if (index > 0 && run.bodies > 0)
      expect_same(recording.exchange_log((index - 1) * run.steps_per_frame + 1,
                                         static_cast<std::uint32_t>(run.steps_per_frame)),
                  run.exchange_log(index));
  }
}

TEST(RoundTrip, GivesBackEveryMessageBitForBit) {
  const TemporaryDirectory directory;
  const FakeRun run{.bodies = 3};
  record(run, directory / "run.h5");
  const Reader recording(directory / "run.h5");
  EXPECT_EQ(recording.ending(), Ending::kFinished);
  EXPECT_EQ(recording.reason(), "FINISHED");
  EXPECT_EQ(recording.detail(), "all steps done");
  EXPECT_EQ(recording.wall_seconds(), 1.5);
  EXPECT_EQ(recording.frames(), run.frames + 1);
  EXPECT_EQ(recording.exchanges(), run.frames * run.steps_per_frame);
  expect_reads_back(recording, run, run.frames + 1);
}

TEST(RoundTrip, WorksWithoutBodies) {
  const TemporaryDirectory directory;
  const FakeRun run{.bodies = 0};
  record(run, directory / "run.h5");
  const Reader recording(directory / "run.h5");
  expect_reads_back(recording, run, run.frames + 1);
}

TEST(RoundTrip, WorksWithFramesLargerThanAChunk) {
  const TemporaryDirectory directory;
  const FakeRun run{.particles = 20'000, .steps_per_frame = 700, .frames = 2};
  record(run, directory / "run.h5");
  expect_reads_back(Reader(directory / "run.h5"), run, run.frames + 1);
}

TEST(RoundTrip, ReadsWhileTheFileIsBeingWritten) {
  const TemporaryDirectory directory;
  const FakeRun run;
  Writer writer(OutputFile(directory / "run.h5", false), run.welcome());
  EXPECT_EQ(Reader(directory / "run.h5").frames(), 0);
  for (std::uint64_t index = 0; index < 5; ++index) {
    if (index > 0) writer.write(run.exchange_log(index));
    writer.write(run.frame(index));
    writer.flush();
    const Reader recording(directory / "run.h5");
    EXPECT_EQ(recording.ending(), Ending::kBeingWritten);
    EXPECT_EQ(recording.reason(), "running");
    ASSERT_EQ(recording.frames(), index + 1);
    expect_reads_back(recording, run, index + 1);
  }
  writer.finish("PARTICIPANT_LOST", "");
  EXPECT_EQ(Reader(directory / "run.h5").reason(), "PARTICIPANT_LOST");
}

TEST(Writer, RefusesWhatDoesNotContinueTheRecording) {
  const TemporaryDirectory directory;
  const FakeRun run;
  Writer writer(OutputFile(directory / "run.h5", false), run.welcome());
  writer.write(run.frame(0));
  EXPECT_THROW(writer.write(run.frame(0)), ProtocolError) << "again";
  EXPECT_THROW(writer.write(run.frame(2)), ProtocolError) << "a frame is missing";
  EXPECT_THROW(writer.write(run.frame(1)), ProtocolError) << "its exchanges are missing";
  EXPECT_THROW(writer.write(run.exchange_log(2)), ProtocolError) << "exchanges are missing";
  writer.write(run.exchange_log(1));
  protocol::Message altered = run.frame(1);
  static_cast<char*>(altered.frames[2].data())[11] ^= 4;
  EXPECT_THROW(writer.write(altered), ProtocolError) << "the hash does not fit";
  const FakeRun other{.particles = 49};
  EXPECT_THROW(writer.write(other.frame(1)), ProtocolError) << "another size";
  EXPECT_THROW(writer.write(run.welcome()), ProtocolError);
  writer.write(run.frame(1));
  writer.finish("FINISHED", "");
  const Reader recording(directory / "run.h5");
  EXPECT_EQ(recording.frames(), 2);
  expect_reads_back(recording, run, 2);
}

TEST(Reader, RefusesFramesThatAreNotThere) {
  const TemporaryDirectory directory;
  record({.frames = 3}, directory / "run.h5");
  const Reader recording(directory / "run.h5");
  try {
    (void)recording.frame(4);
    FAIL();
  } catch (const protocol::InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("no frame 4; choose one of 0 to 3"));
  }
  EXPECT_THROW((void)recording.exchange_log(9, 2), std::out_of_range);
  EXPECT_THROW((void)recording.exchange_log(0, 1), std::out_of_range);
}

TEST(Inspect, SaysWhatIsInTheFile) {
  const TemporaryDirectory directory;
  record({.frames = 3}, directory / "run.h5");
  const Reader recording(directory / "run.h5");
  const std::string text = inspect(recording);
  EXPECT_THAT(text, HasSubstr("50 fluid, 5 boundary"));
  EXPECT_THAT(text, HasSubstr("4 from t = 0 to 0.03 s, step 9 of 9"));
  EXPECT_THAT(text, HasSubstr("FINISHED - all steps done"));
  EXPECT_THAT(text, HasSubstr("body0: ball, free"));
  EXPECT_THAT(inspect_json(recording), HasSubstr("\"fluid_particles\": 50"));
}

// The file as another program sees it: H5MD 1.1.
class Structure : public testing::Test {
 protected:
  void SetUp() override {
    record(FakeRun{}, directory_ / "run.h5");
    file_ = H5Fopen((directory_ / "run.h5").c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
    ASSERT_GE(file_, 0);
  }
  void TearDown() override { H5Fclose(file_); }

  [[nodiscard]] std::vector<hsize_t> shape(const std::string& path) const {
    const hid_t dataset = H5Dopen2(file_, path.c_str(), H5P_DEFAULT);
    EXPECT_GE(dataset, 0) << path;
    const hid_t space = H5Dget_space(dataset);
    std::vector<hsize_t> extents(static_cast<std::size_t>(H5Sget_simple_extent_ndims(space)));
    H5Sget_simple_extent_dims(space, extents.data(), nullptr);
    H5Sclose(space);
    H5Dclose(dataset);
    return extents;
  }
  [[nodiscard]] bool has_attribute(const std::string& object, const std::string& name) const {
    return H5Aexists_by_name(file_, object.c_str(), name.c_str(), H5P_DEFAULT) > 0;
  }

  TemporaryDirectory directory_;
  hid_t file_ = -1;
};

using Extents = std::vector<hsize_t>;

TEST_F(Structure, HasTheMetadataOfH5md) {
  EXPECT_TRUE(has_attribute("/h5md", "version"));
  EXPECT_TRUE(has_attribute("/h5md/author", "name"));
  EXPECT_TRUE(has_attribute("/h5md/creator", "name"));
  EXPECT_TRUE(has_attribute("/h5md/creator", "version"));
  EXPECT_TRUE(has_attribute("/particles/fluid/box", "dimension"));
  EXPECT_TRUE(has_attribute("/particles/fluid/box", "boundary"));
}

TEST_F(Structure, EveryElementHasValueStepAndTime) {
  for (const std::string name : {"position", "velocity"})
    EXPECT_EQ(shape("/particles/fluid/" + name + "/value"), (Extents{21, 50, 3}));
  for (const std::string name : {"density", "pressure"})
    EXPECT_EQ(shape("/particles/fluid/" + name + "/value"), (Extents{21, 50}));
  for (const std::string group : {"/particles/fluid/position", "/particles/fluid/velocity",
                                  "/particles/fluid/density", "/particles/fluid/pressure",
                                  "/observables/energy/kinetic", "/observables/energy/momentum", "/frames"}) {
    EXPECT_EQ(shape(group + "/step"), Extents{21});
    EXPECT_EQ(shape(group + "/time"), Extents{21});
    EXPECT_TRUE(has_attribute(group + "/time", "unit"));
  }
  for (const std::string name : {"position", "velocity", "density", "pressure"})
    EXPECT_TRUE(has_attribute("/particles/fluid/" + name + "/value", "unit"));
  EXPECT_EQ(shape("/observables/energy/kinetic/value"), Extents{21});
  EXPECT_EQ(shape("/observables/energy/momentum/value"), (Extents{21, 3}));
}

TEST_F(Structure, HoldsBoundariesExchangesAndParameters) {
  EXPECT_EQ(shape("/particles/wall/position"), (Extents{4, 3}));
  EXPECT_EQ(shape("/particles/boundary/position"), (Extents{1, 3}));
  EXPECT_EQ(shape("/particles/boundary/body"), Extents{1});
  EXPECT_EQ(shape("/exchange/kinematics"), (Extents{60, 1, 19}));
  EXPECT_EQ(shape("/exchange/wrenches"), (Extents{60, 1, 6}));
  EXPECT_EQ(shape("/exchange/coupling"), (Extents{60, 2}));
  EXPECT_EQ(shape("/exchange/wrench_parts"), (Extents{60, 1, 12}));
  EXPECT_EQ(shape("/exchange/step"), Extents{60});
  EXPECT_EQ(shape("/exchange/time_ns"), Extents{60});
  EXPECT_EQ(shape("/frames/hash"), Extents{21});
  EXPECT_TRUE(has_attribute("/parameters/sound_speed", "unit"));
  EXPECT_TRUE(has_attribute("/status", "reason"));
}

TEST_F(Structure, HasAnXdmfCompanionForEveryFrame) {
  const std::string xdmf = bytes_of(directory_ / "run.xdmf");
  EXPECT_THAT(xdmf, HasSubstr("<Time Value=\"0.2\"/>"));
  EXPECT_THAT(xdmf, HasSubstr("run.h5:/particles/fluid/pressure/value"));
}

// Large enough that the file's own structure does not count.
TEST(RecordingSize, IsThatOfTheFile) {
  const TemporaryDirectory directory;
  const FakeRun run{.particles = 2000, .bodies = 2, .steps_per_frame = 40, .frames = 50};
  record(run, directory / "run.h5");
  const Welcome welcome = run.welcome().header.welcome();
  const double expected =
      static_cast<double>(recording_bytes({.scene = welcome.scene(),
                                           .fluid_particles = run.particles,
                                           .boundary_particles = welcome.boundary_particles(),
                                           .frames = run.frames + 1,
                                           .steps = run.frames * run.steps_per_frame}));
  EXPECT_NEAR(static_cast<double>(std::filesystem::file_size(directory / "run.h5")), expected,
              0.05 * expected);
}

TEST(Archive, HoldsTheSameInLess) {
  const TemporaryDirectory directory;
  const FakeRun run{.particles = 500, .bodies = 2, .steps_per_frame = 5, .frames = 30};
  record(run, directory / "run.h5");
  EXPECT_THAT(archive(directory / "run.h5", directory / "small.h5", false), testing::HasSubstr("small.h5"));
  EXPECT_LT(std::filesystem::file_size(directory / "small.h5"),
            std::filesystem::file_size(directory / "run.h5"));
  const Reader whole(directory / "run.h5"), small(directory / "small.h5");
  EXPECT_EQ(small.reason(), whole.reason());
  EXPECT_EQ(small.run_id(), whole.run_id());
  ASSERT_EQ(small.frames(), whole.frames());
  for (std::uint64_t index = 0; index < whole.frames(); ++index)
    expect_same(small.frame(index), whole.frame(index));
  ASSERT_EQ(small.exchanges(), whole.exchanges());
  expect_same(small.exchange_log(1, 150), whole.exchange_log(1, 150));
  EXPECT_THROW((void)archive(directory / "run.h5", directory / "small.h5", false), protocol::InputError);
  EXPECT_THROW((void)archive(directory / "run.h5", directory / "run.h5", true), protocol::InputError);
}

}  // namespace
}  // namespace sluice::clients::test
