// Recordings of what the scene's output selects: fields, precision, a region, particles in some frames only.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hdf5.h>

#include <cmath>
#include <random>

#include "clients/recording/archive.hpp"
#include "clients/recording/continuation.hpp"
#include "clients/recording/inspect.hpp"
#include "clients/recording/layout.hpp"
#include "clients/recording/reader.hpp"
#include "clients/recording/repair.hpp"
#include "clients/recording/size.hpp"
#include "clients/recording/xdmf.hpp"
#include "tests/unit/clients/killed.hpp"

namespace sluice::clients::test {
namespace {

using protocol::ProtocolError;
using std::chrono::microseconds;
using testing::HasSubstr;

struct Selection {
  const char* name;
  FakeRun run;
  bool is_default = false;
};

Output output(std::initializer_list<ParticleField> fields, Precision precision, unsigned every, bool region) {
  Output result;
  for (const ParticleField field : fields) result.add_field(field);
  if (precision != PRECISION_UNSPECIFIED) result.set_precision(precision);
  if (every > 1) result.set_particles_every(every);
  if (region)
    for (int axis = 0; axis < 2; ++axis) {
      result.mutable_region()->add_min(0.5);
      result.mutable_region()->add_max(1);
    }
  return result;
}

FakeRun run(const Output& output) {
  return {.output = output};
}

const Output kVarying = output({}, PRECISION_UNSPECIFIED, 1, true);

class Selected : public testing::TestWithParam<Selection> {
 protected:
  void expect_reads_back(const std::filesystem::path& path, std::uint64_t frames) const {
    const Reader recording(path);
    ASSERT_GE(recording.frames(), frames);
    for (std::uint64_t index = 0; index < recording.frames(); ++index)
      expect_same(recording.frame(index), run_.frame(index));
  }

  const FakeRun& run_ = GetParam().run;
  const TemporaryDirectory directory_;
  const std::filesystem::path path_ = directory_ / "run.h5";
};

TEST_P(Selected, GivesBackEveryMessageBitForBit) {
  record(run_, path_);
  expect_reads_back(path_, run_.frames + 1);
  expect_same(Reader(path_).welcome_message(), run_.welcome());
  EXPECT_THAT(inspect(Reader(path_)), HasSubstr("21 from t = 0"));
}

TEST_P(Selected, ReadsWhileTheFileIsBeingWritten) {
  Writer writer(OutputFile(path_, false), run_.welcome());
  for (std::uint64_t index = 0; index < 7; ++index) {
    if (index > 0) writer.write(run_.exchange_log(index));
    writer.write(run_.frame(index));
    writer.flush();
    EXPECT_EQ(Reader(path_).frames(), index + 1);
    expect_reads_back(path_, index + 1);
  }
}

TEST_P(Selected, ArchivesAndRepairs) {
  record(run_, path_);
  (void)archive(path_, directory_ / "small.h5", false);
  expect_reads_back(directory_ / "small.h5", run_.frames + 1);
  const protocol::Message frame = run_.frame(12);
  const zmq::message_t& array = frame.frames[frame.header.array(0).name() == "fluid/id" ? 1 : 0];
  std::string bytes = bytes_of(path_);
  const std::size_t at = bytes.find(std::string(array.data<char>(), 24));
  ASSERT_NE(at, std::string::npos);
  bytes[at + 5] ^= 1;
  write_bytes(path_, bytes);
  EXPECT_EQ(repair(path_, {}).kept.frames, 12u);
  expect_reads_back(path_, 12);
}

TEST_P(Selected, GoesOnAfterACheckpoint) {
  record(run_, path_);
  protocol::Message welcome = run_.welcome();
  welcome.header.mutable_welcome()->set_done(12 * run_.steps_per_frame);
  Continuation continuation(path_, directory_ / "on.h5", false, std::move(welcome));
  for (std::uint64_t index = 13; index <= run_.frames; ++index) {
    continuation.writer().write(run_.exchange_log(index));
    continuation.writer().write(run_.frame(index));
  }
  continuation.writer().finish("FINISHED", "");
  expect_reads_back(directory_ / "on.h5", run_.frames + 1);
}

TEST_P(Selected, KeepsEveryAcknowledgedFrameOfAKilledRecorder) {
  const unsigned seed = std::random_device()();
  std::mt19937 random(seed);
  for (int i = 0; i < 6; ++i) {
    const std::uint64_t frames = std::uniform_int_distribution<std::uint64_t>(1, run_.frames)(random);
    const microseconds delay(std::uniform_int_distribution<int>(0, 2000)(random));
    SCOPED_TRACE(testing::Message() << "seed " << seed << ", kill " << i);
    const Killed killed = kill_after([&](int pipe) { record_aloud(run_, path_, pipe, true); }, frames, delay);
    const std::uint64_t kept = killed.acknowledged == kFinished ? run_.frames + 1 : killed.acknowledged;
    expect_reads_back(path_, kept);
    repair(path_, {});
    expect_reads_back(path_, kept);
    std::filesystem::remove(directory_ / "run.damaged.h5");
  }
}

TEST_P(Selected, IsOfAFormatThatOlderProgramsRefuse) {
  EXPECT_EQ(layout::selects(run_.welcome().header.welcome().scene()), !GetParam().is_default);
}

INSTANTIATE_TEST_SUITE_P(
    Output, Selected,
    testing::Values(
        Selection{"Default", run({}), true},
        Selection{"PositionAlone", run(output({POSITION}, PRECISION_UNSPECIFIED, 1, false))},
        Selection{"Single", run(output({}, FLOAT32, 1, false))},
        Selection{"EveryThird", run(output({VELOCITY}, FLOAT64, 3, false))},
        Selection{"Region", run(kVarying)},
        Selection{"All", {.particles = 3000, .bodies = 2, .output = output({PRESSURE}, FLOAT32, 4, true)}}),
    [](const auto& test) { return test.param.name; });

TEST(Selection, SaysHowManyParticlesAFrameHas) {
  const TemporaryDirectory directory;
  const FakeRun whole, some = run(output({}, PRECISION_UNSPECIFIED, 2, true));
  record(whole, directory / "whole.h5");
  record(some, directory / "some.h5");
  EXPECT_EQ(Reader(directory / "whole.h5").particles(3), 50u);
  const Reader recording(directory / "some.h5");
  EXPECT_EQ(recording.particles(3), 0u);
  EXPECT_EQ(recording.particles(4), some.particles_in(4));
}

TEST(Selection, IsInspected) {
  const TemporaryDirectory directory;
  record(run(output({VELOCITY}, FLOAT32, 5, true)), directory / "run.h5");
  EXPECT_THAT(
      inspect(Reader(directory / "run.h5")),
      HasSubstr("position, velocity in single precision, of frames 0, 5, 10 ...; up to 90 particles at a "
                "time, from (0.5, 0.5) to (1, 1) m"));
  record(FakeRun{}, directory / "whole.h5");
  EXPECT_THAT(inspect(Reader(directory / "whole.h5")), Not(HasSubstr("recorded")));
}

TEST(Selection, RefusesWhatTheSceneDoesNotSay) {
  const TemporaryDirectory directory;
  const FakeRun some = run(kVarying);
  Writer writer(OutputFile(directory / "run.h5", false), some.welcome());
  EXPECT_THROW(writer.write(FakeRun{}.frame(0)), ProtocolError) << "all particles, no identities";
  protocol::Message twice = some.frame(0);
  auto* ids = twice.frames[0].data<std::int64_t>();
  ids[1] = ids[0];
  twice.header.mutable_frame()->set_hash(twice.hash_arrays());
  EXPECT_THROW(writer.write(twice), ProtocolError) << "one particle twice";
  protocol::Message more = some.frame(0);
  more.add_array<double>("more", std::vector<double>{1}, {1});
  more.header.mutable_frame()->set_hash(more.hash_arrays());
  EXPECT_THROW(writer.write(more), ProtocolError) << "an array that nobody knows";
  writer.write(some.frame(0));
}

// The file as another program sees it, by H5MD.
TEST(Selection, LeavesFillValuesInEmptySlots) {
  const TemporaryDirectory directory;
  const FakeRun some = run(output({VELOCITY}, FLOAT32, 5, true));
  record(some, directory / "run.h5");
  ASSERT_EQ(some.particles_in(10), 75u);
  ASSERT_EQ(some.particles_in(15), 60u);
  ASSERT_EQ(some.particles_in(5), 90u);
  const hid_t file = H5Fopen((directory / "run.h5").c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  const auto read = [&](const char* path, hid_t type, auto& values, std::vector<hsize_t> expected) {
    const hid_t dataset = H5Dopen2(file, path, H5P_DEFAULT);
    const hid_t space = H5Dget_space(dataset);
    std::vector<hsize_t> extents(static_cast<std::size_t>(H5Sget_simple_extent_ndims(space)));
    H5Sget_simple_extent_dims(space, extents.data(), nullptr);
    EXPECT_EQ(extents, expected) << path;
    H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
    H5Sclose(space);
    H5Dclose(dataset);
  };
  std::vector<std::int64_t> ids(5 * 90);
  std::vector<float> velocity(5 * 90 * 3);
  std::vector<double> times(5);
  read("/particles/fluid/id/value", H5T_NATIVE_INT64, ids, {5, 90});
  read("/particles/fluid/velocity/value", H5T_NATIVE_FLOAT, velocity, {5, 90, 3});
  read("/particles/fluid/id/time", H5T_NATIVE_DOUBLE, times, {5});
  for (std::size_t k = 0; k < times.size(); ++k) EXPECT_DOUBLE_EQ(times[k], 0.05 * static_cast<double>(k));
  EXPECT_EQ(H5Lexists(file, "/particles/fluid/density", H5P_DEFAULT), 0);
  H5Fclose(file);
  EXPECT_EQ(ids[2 * 90 + 74], 3 * 74 + 10);
  EXPECT_EQ(ids[2 * 90 + 75], -1);
  EXPECT_FALSE(std::isnan(velocity[(2 * 90 + 74) * 3]));
  EXPECT_TRUE(std::isnan(velocity[(2 * 90 + 75) * 3]));
}

TEST(Selection, TheSizeEstimateFollowsIt) {
  const TemporaryDirectory directory;
  const FakeRun some{.particles = 20'000,
                     .steps_per_frame = 5,
                     .frames = 60,
                     .output = output({PRESSURE}, FLOAT32, 3, false)};
  record(some, directory / "run.h5");
  const Welcome welcome = some.welcome().header.welcome();
  const auto expected =
      static_cast<double>(recording_bytes({.scene = welcome.scene(),
                                           .fluid_particles = some.particles,
                                           .boundary_particles = welcome.boundary_particles(),
                                           .frames = some.frames + 1,
                                           .steps = some.frames * some.steps_per_frame}));
  EXPECT_NEAR(static_cast<double>(std::filesystem::file_size(directory / "run.h5")), expected,
              0.05 * expected);
}

TEST(Selection, ARegionHoldsNoMoreThanFitsIntoIt) {
  Scene scene = run(kVarying).welcome().header.welcome().scene();  // [0.5, 1]^2 at a spacing of 0.1
  EXPECT_EQ(most_recorded(scene, 1000), 25u);
  EXPECT_EQ(most_recorded(scene, 20), 20u);
  scene.mutable_output()->mutable_region()->set_max(0, 100);  // the tank ends at 2
  EXPECT_EQ(most_recorded(scene, 1000), 75u);
  scene.mutable_output()->clear_region();
  EXPECT_EQ(most_recorded(scene, 1000), 1000u);
}

TEST(Selection, TheCompanionNamesWhatIsThere) {
  const TemporaryDirectory directory;
  record(run(output({PRESSURE}, FLOAT32, 2, true)), directory / "run.h5");
  const std::string xdmf = bytes_of(directory / "run.xdmf");
  EXPECT_THAT(xdmf, HasSubstr("Precision=\"4\" Format=\"HDF\">run.xdmf.h5:/2/pressure"));
  EXPECT_THAT(xdmf, Not(HasSubstr("velocity")));
  EXPECT_THAT(xdmf, Not(HasSubstr("<Time Value=\"0.01\"/>")));
  EXPECT_THAT(xdmf, HasSubstr("<Time Value=\"0.02\"/>"));
}

// As another program reads them, wherever it was started.
TEST_P(Selected, TheCompanionHasAViewOfEveryFrame) {
  record(run_, path_);
  const hid_t file = H5Fopen((directory_ / "run.xdmf.h5").c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  ASSERT_GE(file, 0);
  int frames = 0;
  for (std::uint64_t index = 0; index <= run_.frames; ++index) {
    const protocol::Message frame = run_.frame(index);
    if (!frame.has_array("fluid/position") || frame.shape("fluid/position")[0] == 0) continue;
    ++frames;
    for (int i = 0; i < frame.header.array_size(); ++i) {
      const std::string name = frame.header.array(i).name();
      if (!name.starts_with("fluid/")) continue;
      const hid_t view = H5Dopen2(file, ("/" + std::to_string(index) + name.substr(5)).c_str(), H5P_DEFAULT);
      ASSERT_GE(view, 0) << name << " of frame " << index;
      const zmq::message_t& expected = frame.frames[static_cast<std::size_t>(i)];
      std::string bytes(expected.size(), ' ');
      const hid_t type = H5Dget_type(view);
      H5Dread(view, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes.data());
      EXPECT_EQ(bytes, expected.to_string()) << name << " of frame " << index;
      H5Tclose(type);
      H5Dclose(view);
    }
  }
  H5Fclose(file);
  EXPECT_GT(frames, 4);
}

}  // namespace
}  // namespace sluice::clients::test
