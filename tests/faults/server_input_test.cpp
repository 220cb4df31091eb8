// The server program and input it must refuse.
#include <gmock/gmock.h>

#include "tests/coupling/directory.hpp"
#include "tests/faults/child.hpp"
#include "tests/faults/scene_files.hpp"

namespace sluice::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::MatchesRegex;

constexpr std::chrono::seconds kPatient{60};

class ServerInput : public ::testing::Test {
 protected:
  // Runs the server on a scene's text; returns what it says after it has exited with `code`.
  std::string run(int code, const std::string& scene, std::vector<std::string> options = {}) {
    const std::string file = write_file(directory_.path() / "test.scene", scene);
    options.insert(options.begin(), {"--scene", file, "--listen", directory_.endpoint()});
    Child server("sluice-server", options, directory_.path() / "server.log");
    EXPECT_EQ(server.wait(kPatient), code) << server.log();
    return server.log();
  }

  Directory directory_;
};

TEST_F(ServerInput, UnknownFieldIsNamedWithItsPlace) {
  EXPECT_THAT(run(1, kEndlessTank + "spacign: 0.1\n"),
              MatchesRegex("(.*\n)*.*test.scene:10:[0-9]+.*spacign.*\n(.*\n)*"));
}

TEST_F(ServerInput, NegativeSpacingIsNamedWithItsPlace) {
  const std::string log = run(1, "dimension: 2\n  spacing: -0.1\nduration: 1\n");
  EXPECT_THAT(log, HasSubstr("test.scene:2:3: "));
  EXPECT_THAT(log, HasSubstr("-0.1"));
}

TEST_F(ServerInput, ABodyInTheLiquidIsNamedWithItsPlace) {
  const std::string log = run(
      1, kEndlessTank + "body { name: \"buoy\" ball { radius: 0.1 } density: 500 position: [0.5, 0.2] }\n");
  EXPECT_THAT(log, HasSubstr("test.scene:10:"));
  EXPECT_THAT(log, HasSubstr("\"buoy\" stands in liquid"));
}

TEST_F(ServerInput, AbsentSceneIsNamed) {
  Child server("sluice-server",
               {"--scene", (directory_.path() / "absent.scene").string(), "--listen", directory_.endpoint()},
               directory_.path() / "server.log");
  EXPECT_EQ(server.wait(kPatient), 1);
  EXPECT_THAT(server.log(), HasSubstr("absent.scene"));
}

TEST_F(ServerInput, EndpointInUseIsNamed) {
  const std::string file = write_file(directory_.path() / "first.scene", kEndlessTank + kFreeBall);
  Child first("sluice-server", {"--scene", file, "--listen", directory_.endpoint()},
              directory_.path() / "first.log");
  // It holds the endpoint from when its lock file exists; the second may be started only then.
  while (!std::filesystem::exists(directory_.path() / "server.record")) {
    ASSERT_FALSE(first.wait(std::chrono::milliseconds(10))) << first.log();
  }
  EXPECT_THAT(run(1, kEndlessTank), HasSubstr(directory_.endpoint() + " is in use"));
  EXPECT_FALSE(first.wait(std::chrono::milliseconds(0)));  // and the first is unharmed
}

TEST_F(ServerInput, UnusableEndpointsAreRefused) {
  for (const char* endpoint : {"nonsense", "tcp://192.0.2.1:5555", "ipc:///nowhere/at/all"}) {
    const std::string file = write_file(directory_.path() / "test.scene", kEndlessTank);
    Child server("sluice-server", {"--scene", file, "--listen", endpoint}, directory_.path() / "server.log");
    EXPECT_EQ(server.wait(kPatient), 1);
    EXPECT_THAT(server.log(), HasSubstr(endpoint));
  }
}

TEST_F(ServerInput, BadArgumentsAreRefused) {
  run(1, kEndlessTank, {"--threads", "0"});
  run(1, kEndlessTank, {"--until", "-1"});
  run(1, kEndlessTank, {"--no-such-option"});
  run(1, kEndlessTank, {"--set", "spacing=abc"});
}

TEST_F(ServerInput, ARunThatNeedsNobodyRuns) {
  EXPECT_THAT(run(0, kEndlessTank, {"--until", "0.02"}), HasSubstr("status: FINISHED - "));
}

TEST_F(ServerInput, OverridesReachTheRun) {
  EXPECT_THAT(run(0, kEndlessTank, {"--until", "0.02", "--set", "spacing=0.1"}), HasSubstr("40 fluid"));
}

}  // namespace
}  // namespace sluice::testing
