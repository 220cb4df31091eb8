// What the server sees of the exchange's stability as a run goes: recorded, and refused.
#include <gmock/gmock.h>

#include "tests/end_to_end/recorded_run.hpp"

namespace sluice::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class StabilityWatched : public RecordedRun {
 protected:
  [[nodiscard]] static double indicator(const clients::Reader& recording, std::uint64_t step) {
    return recording.exchange_log(step, 1).array<double>("indicator")[0];
  }
};

// In the air nothing resists; in the water less than with all of the surface wet.
TEST_F(StabilityWatched, IndicatorOfWhatIsWetIsRecorded) {
  run("falling_cylinder", "cylinder.h5",
      {"--set", "spacing=0.011", "--set", "body[0].position=[0.605, 0.52]", "--until", "0.1"});
  const clients::Reader recording = read("cylinder.h5");
  const double whole = recording.welcome().stability(0).indicator();
  EXPECT_EQ(indicator(recording, 1), 0);
  EXPECT_GT(indicator(recording, recording.exchanges()), 0.1 * whole);
  EXPECT_LT(indicator(recording, recording.exchanges()), whole);
}

TEST_F(StabilityWatched, LightBodyIsRefusedOnceItIsWet) {
  const std::vector<std::string> arguments{
      "run",     std::string(SLUICE_SOURCE) + "/clients/scenes/floating_box.scene",
      "-o",      "box.h5",
      "--set",   "spacing=0.03",
      "--set",   "body[0].density=20",
      "--set",   "coupling={scheme: EXPLICIT shorten_steps: false when_unstable: REFUSE}",
      "--until", "0.1"};
  const Outcome outcome = run_program("sluice", arguments, path(""));
  EXPECT_EQ(outcome.code, 3);
  EXPECT_THAT(outcome.out + outcome.err, AllOf(HasSubstr("body 'box' at t ="), HasSubstr("scheme: AUTO")));
  const clients::Reader recording = read("box.h5");
  EXPECT_EQ(recording.reason(), "UNSTABLE");
}

}  // namespace
}  // namespace sluice::test
