// A user's Ctrl-C: the run ends in order, and what was recorded stays.
#include <gmock/gmock.h>
#include <poll.h>

#include <csignal>
#include <nlohmann/json.hpp>

#include "clients/sluice/process.hpp"
#include "tests/cli/command.hpp"
#include "tests/cli/scenes.hpp"

namespace sluice::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

// Reads what the program writes until a line holds the text; false when its output ends before.
bool read_until(clients::Child& child, const std::string& text, std::string& all) {
  while (child.output() >= 0 && all.find(text) == std::string::npos) {
    pollfd item{child.output(), POLLIN, 0};
    poll(&item, 1, -1);
    child.read_output([&](const std::string& line) { all += line + "\n"; });
  }
  return all.find(text) != std::string::npos;
}

TEST(Interrupt, EndsTheRunInOrderAndKeepsTheRecording) {
  const TemporaryDirectory directory;
  const auto scene = directory.write("long.scene", with(kSmallScene, "duration: 0.02", "duration: 1000"));
  const auto output = directory.path() / "out.h5";
  clients::Child run(std::string(SLUICE_BIN) + "/sluice",
                     {"run", scene.string(), "-o", output.string(), "--json", "--set",
                      "body[0].prescribed.constant.velocity=[0, 0]"});
  std::string text;
  ASSERT_TRUE(read_until(run, "steps/s  ETA", text)) << text;  // the first progress: the run has begun
  run.signal(SIGINT);
  read_until(run, "\n}\n", text);  // the end of the summary
  EXPECT_EQ(run.wait(), 2);
  const json summary = json::parse(text.substr(text.find("\n{\n")));
  EXPECT_EQ(summary.at("status"), "INTERRUPTED");
  EXPECT_EQ(summary.at("exit_code"), 2);

  const Outcome inspected = run_program("sluice", {"inspect", output.string()}, directory.path());
  EXPECT_EQ(inspected.code, 0) << inspected.err;
  EXPECT_THAT(inspected.out, HasSubstr("INTERRUPTED"));
}

}  // namespace
}  // namespace sluice::test
