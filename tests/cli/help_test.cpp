#include <gmock/gmock.h>

#include "tests/cli/command.hpp"

namespace sluice::test {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

const std::vector<std::string> kCommands{"run",     "check", "serve", "rigid",  "record", "watch",  "replay",
                                         "inspect", "plot",  "movie", "export", "diff",   "python", "keygen"};

TEST(Help, NamesEveryCommand) {
  const TemporaryDirectory directory;
  const Outcome outcome = run_program("sluice", {"--help"}, directory.path());
  EXPECT_EQ(outcome.code, 0);
  for (const std::string& command : kCommands)
    EXPECT_THAT(outcome.out, HasSubstr("\n  " + command + " ")) << command;
}

TEST(Help, EveryCommandExplainsItself) {
  const TemporaryDirectory directory;
  for (const std::string& command : kCommands) {
    const Outcome outcome = run_program("sluice", {command, "--help"}, directory.path());
    EXPECT_EQ(outcome.code, 0) << command << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("--help")) << command;
  }
}

TEST(Help, VersionNamesTheProtocolToo) {
  const TemporaryDirectory directory;
  const Outcome outcome = run_program("sluice", {"--version"}, directory.path());
  EXPECT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.out, testing::MatchesRegex("sluice [0-9.]+ \\(protocol [0-9]+\\)\n"));
}

TEST(Help, WrongUseIsBadInputAndSaysHow) {
  const TemporaryDirectory directory;
  const std::vector<std::vector<std::string>> wrong{
      {}, {"fly"}, {"run"}, {"run", "a.scene", "--threads", "0"}, {"run", "a.scene", "--until", "-1"}};
  for (const auto& arguments : wrong) {
    const Outcome outcome = run_program("sluice", arguments, directory.path());
    EXPECT_EQ(outcome.code, 1) << testing::PrintToString(arguments);
    EXPECT_THAT(outcome.err, Not(IsEmpty()));
    EXPECT_THAT(outcome.out, IsEmpty());
  }
}

}  // namespace
}  // namespace sluice::test
