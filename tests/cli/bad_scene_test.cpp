// Scenes that cannot work: `run` and `check` refuse each with its place in the file, and write nothing.
#include <gmock/gmock.h>

#include "tests/cli/command.hpp"
#include "tests/cli/scenes.hpp"

namespace sluice::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

struct Bad {
  const char* name;
  const char* from;
  const char* to;
  const char* place;  // line:column
  const char* says;
};

const std::string kSecondBody = R"(body {
  name: "block"
  box { size: [0.04, 0.04] }
  density: 500
  position: [0.25, 0.1]
}
output)";

const std::string kOverlappingBody = with(kSecondBody, "0.25, 0.1", "0.125, 0.1");
const std::string kSubmergedBody = with(kSecondBody, "0.25, 0.1", "0.05, 0.05");

const Bad kBad[]{
    {"unknown_field", "spacing:", "spaceing: 1\nspacing:", "3:1", "spaceing"},
    {"nan", "duration: 0.02", "duration: nan", "4:1", "nan"},
    {"negative_spacing", "spacing: 0.01", "spacing: -0.01", "3:1", "-0.01"},
    {"body_in_fluid", "output", kSubmergedBody.c_str(), "13:1", "block"},
    {"overlapping_bodies", "output", kOverlappingBody.c_str(), "13:1", "gate"},
    {"gate_leaves_domain", "velocity: [0, 0.7]", "velocity: [25, 0]", "11:", "gate"},
    {"syntax", "dimension: 2", "dimension: = 2", "2:12", ""},
};

class BadScene : public testing::TestWithParam<Bad> {};

TEST_P(BadScene, IsRefusedWithItsPlaceAndNothingIsWritten) {
  const Bad& bad = GetParam();
  const std::vector<std::vector<std::string>> commands{{"check", "bad.scene"},
                                                       {"run", "bad.scene", "-o", "out.h5"},
                                                       {"run", "bad.scene", "-o", "out.h5", "--json"}};
  for (const auto& command : commands) {
    const TemporaryDirectory directory;
    directory.write("bad.scene", with(kSmallScene, bad.from, bad.to));
    const Outcome outcome = run_program("sluice", command, directory.path());
    EXPECT_EQ(outcome.code, 1) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("bad.scene:" + std::string(bad.place)));
    EXPECT_THAT(outcome.err, HasSubstr(bad.says));
    EXPECT_THAT(directory.list(), ElementsAre("bad.scene"));
    if (command.back() != "--json") {
      EXPECT_THAT(outcome.out, IsEmpty());
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Cli, BadScene, testing::ValuesIn(kBad),
                         [](const auto& bad) { return bad.param.name; });

TEST(BadScene, EveryProblemIsNamedAtOnce) {
  const TemporaryDirectory directory;
  std::string text = with(kSmallScene, "spacing: 0.01", "spacing: -0.01");
  directory.write("bad.scene", with(text, "rate: 100", "rate: inf"));
  const Outcome outcome = run_program("sluice", {"check", "bad.scene"}, directory.path());
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("bad.scene:3:1: spacing"));
  EXPECT_THAT(outcome.err, HasSubstr("bad.scene:13:10: output.rate"));
}

TEST(BadScene, AnOverrideIsCheckedLikeTheFile) {
  const TemporaryDirectory directory;
  directory.write("good.scene", kSmallScene);
  const Outcome outcome =
      run_program("sluice", {"check", "good.scene", "--set", "spacing=0"}, directory.path());
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("--set spacing=0"));
}

TEST(BadScene, TheUnbrokenOnePasses) {
  const TemporaryDirectory directory;
  directory.write("good.scene", kSmallScene);
  const Outcome outcome = run_program("sluice", {"check", "good.scene"}, directory.path());
  EXPECT_EQ(outcome.code, 0) << outcome.err;
}

}  // namespace
}  // namespace sluice::test
