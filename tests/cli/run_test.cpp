// `sluice run` to its end, with real processes.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "tests/cli/command.hpp"
#include "tests/cli/scenes.hpp"

namespace sluice::test {
namespace {

using nlohmann::json;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

class Run : public testing::Test {
 protected:
  Run() { directory.write("small.scene", kSmallScene); }
  Outcome run(std::vector<std::string> options) const {
    options.insert(options.begin(), {"run", "small.scene"});
    return run_program("sluice", options, directory.path());
  }
  TemporaryDirectory directory;
};

TEST_F(Run, JsonIsOneObjectAndNothingElse) {
  const Outcome outcome = run({"-o", "out.h5", "--json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const json summary = json::parse(outcome.out);  // throws on anything before or after the object
  EXPECT_EQ(summary.at("scene"), "small");
  EXPECT_EQ(summary.at("status"), "FINISHED");
  EXPECT_EQ(summary.at("exit_code"), 0);
  EXPECT_EQ(summary.at("fluid_particles"), 100);
  EXPECT_EQ(summary.at("step"), summary.at("steps"));
  EXPECT_DOUBLE_EQ(summary.at("time"), 0.02);
  EXPECT_EQ(summary.at("recording").at("path"), "out.h5");
  EXPECT_GT(summary.at("energy").at("start").at("potential"), 0);
  EXPECT_GT(summary.at("energy").at("end").at("kinetic"), 0);
}

TEST_F(Run, JsonOfARefusalIsOneObjectToo) {
  const Outcome outcome = run({"--set", "spacing=-1", "--json"});
  EXPECT_EQ(outcome.code, 1);
  const json summary = json::parse(outcome.out);
  EXPECT_EQ(summary.at("status"), "BAD_INPUT");
  EXPECT_THAT(summary.at("detail").get<std::string>(), HasSubstr("spacing"));
}

TEST_F(Run, TheSummaryIsATableOfTheRun) {
  const Outcome outcome = run({"-o", "out.h5"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  for (const char* word : {"scene", "100 fluid", "simulated time", "particle steps/s", "energy at start",
                           "energy at end", "FINISHED", "out.h5"})
    EXPECT_THAT(outcome.out, HasSubstr(word));
  EXPECT_THAT(outcome.err, HasSubstr("steps/s  ETA"));  // progress lines, as stderr is no terminal
  EXPECT_THAT(outcome.err, Not(HasSubstr("\r")));
}

TEST_F(Run, WithoutAnOutputNothingIsLeft) {
  const auto before = directory.list();
  const Outcome outcome = run({});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(directory.list(), before);
}

TEST_F(Run, ForceReplacesARecording) {
  directory.write("out.h5", "old");
  EXPECT_EQ(run({"-o", "out.h5", "--force"}).code, 0);
  EXPECT_EQ(run_program("sluice", {"inspect", "out.h5"}, directory.path()).code, 0);
}

TEST_F(Run, UntilStopsEarlier) {
  const Outcome outcome = run({"--until", "0.01", "--json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_DOUBLE_EQ(json::parse(outcome.out).at("time"), 0.01);
}

TEST_F(Run, ASceneWithoutBodiesNeedsNoRigidProcess) {
  const auto body = kSmallScene.find("body");
  const auto output = kSmallScene.find("output");
  directory.write("tank.scene", std::string(kSmallScene).erase(body, output - body));
  const Outcome outcome = run_program("sluice", {"run", "tank.scene", "--verbose"}, directory.path());
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, Not(HasSubstr("sluice-rigid")));
}

}  // namespace
}  // namespace sluice::test
