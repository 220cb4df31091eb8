// Broken recordings and checkpoints: a clear error or what was recorded, never a crash. A second of each in a
// run of all tests; SLUICE_FUZZ_SECONDS=600 goes on for as long, SLUICE_FUZZ_SEED repeats a run. What a crash
// leaves in the temporary directory is the file that it was about.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>

#include "clients/recording/inspect.hpp"
#include "clients/recording/output_file.hpp"
#include "clients/recording/repair.hpp"
#include "clients/recording/writer.hpp"
#include "clients/recording/xdmf.hpp"
#include "protocol/checkpoint_file.hpp"
#include "protocol/error.hpp"
#include "tests/fuzz/mutation.hpp"
#include "tests/unit/clients/fake_run.hpp"

namespace sluice::test {
namespace {

using clients::test::bytes_of;
using clients::test::FakeRun;
using clients::test::TemporaryDirectory;
using clients::test::write_bytes;
using protocol::InputError;
using std::chrono::steady_clock;

class Fuzz : public testing::Test {
 protected:
  Fuzz() { std::cout << "seed " << seed_ << ", files in " << (directory_ / "").string() << "\n"; }

  // Calls look(mutated bytes of one of the originals) until the time is over.
  template <typename Look>
  void repeat(const std::vector<std::string>& originals, const Look& look) {
    const char* seconds = std::getenv("SLUICE_FUZZ_SECONDS");
    const auto end = steady_clock::now() + std::chrono::duration<double>(seconds ? std::atof(seconds) : 1.0);
    std::size_t cases = 0;
    for (; steady_clock::now() < end && !HasFailure(); ++cases) {
      SCOPED_TRACE(testing::Message() << "seed " << seed_ << ", case " << cases);
      look(mutated(originals[cases % originals.size()], random_));
    }
    std::cout << cases << " files, " << refused_ << " refused\n";
    EXPECT_GT(cases, 0u);
    EXPECT_GT(refused_, 0u);
  }

  // Anything but an InputError that says something is a failure.
  template <typename Action>
  bool accepted(const Action& action) {
    try {
      action();
      return true;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr("file"));
      ++refused_;
      return false;
    }
  }

  TemporaryDirectory directory_;

 private:
  const std::uint64_t seed_ = std::getenv("SLUICE_FUZZ_SEED")
                                  ? std::strtoull(std::getenv("SLUICE_FUZZ_SEED"), nullptr, 10)
                                  : std::random_device()();
  std::mt19937_64 random_{seed_};
  std::size_t refused_ = 0;
};

// With all particles in every frame, and with a number that differs, in every second.
FakeRun make_run(bool is_selected) {
  FakeRun run{.particles = 60, .bodies = 2, .steps_per_frame = 7, .frames = 12};
  if (!is_selected) return run;
  run.output.set_precision(FLOAT32);
  run.output.set_particles_every(2);
  for (int axis = 0; axis < 2; ++axis) run.output.mutable_region()->add_min(0);
  for (int axis = 0; axis < 2; ++axis) run.output.mutable_region()->add_max(1);
  return run;
}

const FakeRun kWhole = make_run(false), kSelected = make_run(true);

// All that any program reads of a recording. A frame that reads is one that was recorded.
void read_all(const std::filesystem::path& path) {
  const clients::Reader recording(path);
  (void)clients::inspect(recording);
  (void)clients::inspect_json(recording);
  (void)recording.welcome_message();
  (void)recording.slots();
  const FakeRun& run = recording.scene().output().has_region() ? kSelected : kWhole;
  for (std::uint64_t index = 0; index < recording.frames(); ++index) {
    const protocol::Message frame = recording.frame(index);
    ASSERT_EQ(frame.hash_arrays(), run.frame(index).hash_arrays()) << "frame " << index;
    (void)recording.particles(index);
  }
  for (std::uint64_t step = 1; step <= recording.exchanges(); ++step) (void)recording.exchange_log(step, 1);
}

// What a repair makes is whole, whatever it was made from.
void repair_into(const std::filesystem::path& from, const std::filesystem::path& to) {
  std::filesystem::remove(to);
  if (clients::repair(from, to).repaired.empty()) return;
  const clients::Reader repaired(to);
  EXPECT_EQ(repaired.ending(), clients::Ending::kFinished);
  read_all(to);
}

std::string finished(const FakeRun& run, const std::filesystem::path& path) {
  record(run, path);
  return bytes_of(path);
}

// As a killed recorder leaves it: a copy of a file whose writer has flushed and not closed it.
std::string unfinished(const FakeRun& run, const std::filesystem::path& path) {
  clients::Writer writer(clients::OutputFile(path, false), run.welcome());
  for (std::uint64_t index = 0; index <= run.frames; ++index) {
    if (index > 0) writer.write(run.exchange_log(index));
    writer.write(run.frame(index));
  }
  writer.flush();
  return bytes_of(path);
}

TEST_F(Fuzz, Recordings) {
  const auto path = directory_ / "file.h5";
  const std::vector<std::string> originals{
      finished(kWhole, directory_ / "finished.h5"), unfinished(kWhole, directory_ / "unfinished.h5"),
      finished(kSelected, directory_ / "selected.h5"), unfinished(kSelected, directory_ / "selected_cut.h5")};
  repeat(originals, [&](const std::string& bytes) {
    write_bytes(path, bytes);
    (void)accepted([&] { read_all(path); });
    (void)accepted([&] { repair_into(path, directory_ / "repaired_file.h5"); });
    try {
      clients::write_xdmf(path);
    } catch (const std::runtime_error&) {  // whatever it says: nobody but a recorder asks for it
    }
  });
}

TEST_F(Fuzz, Checkpoints) {
  const auto path = directory_ / "file.checkpoint";
  protocol::CheckpointFile whole;
  whole.header.set_run_id("0123456789abcdef");
  whole.header.set_step(40);
  *whole.header.mutable_scene() = kWhole.welcome().header.welcome().scene();
  whole.fluid.assign(5000, std::byte{7});
  whole.rigid.assign(81, 0.5);
  protocol::write_checkpoint(path, whole);
  const std::string original = bytes_of(path);
  repeat({original}, [&](const std::string& bytes) {
    write_bytes(path, bytes);
    if (!accepted([&] { (void)protocol::read_checkpoint(path); })) return;
    EXPECT_TRUE(bytes == original) << "a checkpoint that was changed was read";
  });
}

}  // namespace
}  // namespace sluice::test
