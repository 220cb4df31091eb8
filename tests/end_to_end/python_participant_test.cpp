// A participant in Python moves the bodies as `sluice rigid` does; the examples do what they say.
#include <gmock/gmock.h>

#include <cmath>
#include <regex>

#include "tests/end_to_end/recorded_run.hpp"

namespace sluice::test {
namespace {

class PythonParticipant : public RecordedRun {
 protected:
  void run_with(const std::string& program, const std::string& scene, const std::string& options) {
    const std::string source = SLUICE_SOURCE, bin = SLUICE_BIN;
    script("sluice serve --scene " + source + "/clients/scenes/" + scene + ".scene " + options +
           " --listen ipc://live.ipc --expect-recorder &\n"
           "server=$!\n"
           "sluice record --connect ipc://live.ipc -o live.h5 &\n"
           "recorder=$!\n"
           "PYTHONPATH=" +
           bin + "/../lib/sluice/python /usr/bin/python3 " + source + "/clients/examples/" + program +
           " ipc://live.ipc\n"
           "wait $server\n"
           "wait $recorder\n");
  }
};

TEST_F(PythonParticipant, MovesAFreeBodyAsTheRigidProcessDoes) {
  run_with("falling_body.py", "falling_cylinder", "--set spacing=0.022 --until 0.1 --threads 1");
  run("falling_cylinder", "rigid.h5", {"--set", "spacing=0.022", "--until", "0.1", "--threads", "1"});
  const clients::Reader live = read("live.h5"), rigid = read("rigid.h5");
  ASSERT_EQ(live.exchanges(), rigid.exchanges());
  ASSERT_GT(live.exchanges(), 100u);
  // Both compute the same; what their round-off makes of the splash later differs.
  const auto difference = [&](std::uint64_t step) {
    const auto a = live.exchange_log(step, 1), b = rigid.exchange_log(step, 1);
    double largest = 0;
    for (const std::size_t column : {0u, 1u, 7u, 8u})
      largest = std::max(
          largest, std::abs(a.array<double>("kinematics")[column] - b.array<double>("kinematics")[column]));
    return largest;
  };
  for (std::uint64_t step = 1; step <= 50; ++step) ASSERT_LT(difference(step), 1e-12) << step;
  const double y = live.exchange_log(live.exchanges(), 1).array<double>("kinematics")[1];
  EXPECT_LT(y, 0.35);
  EXPECT_NEAR(y, rigid.exchange_log(rigid.exchanges(), 1).array<double>("kinematics")[1], 2e-3);
}

TEST_F(PythonParticipant, LiftsAGateByWhatTheWaterDoes) {
  run_with("watched_gate.py", "rising_gate", "--set spacing=0.004 --until 0.2 --threads 1");
  const clients::Reader live = read("live.h5");
  const auto last = live.exchange_log(live.exchanges(), 1);
  EXPECT_GT(last.array<double>("kinematics")[1], 0.06 + 0.02);
}

class PythonExample : public RecordedRun {
 protected:
  // Runs an example with the package of the build; what it printed.
  std::string example(const std::string& words) const {
    const std::string source = SLUICE_SOURCE, bin = SLUICE_BIN;
    return script("PYTHONPATH=" + bin + "/../lib/sluice/python /usr/bin/python3 -B " + source +
                  "/clients/examples/" + words);
  }
};

// Shut, the gate leaves the channel at the 0.12 m of its weir; open, it lets it rise to the reservoir's.
TEST_F(PythonExample, AControllerHoldsTheLevel) {
  example("hold_level.py level.h5");
  const clients::Reader level = read("level.h5");
  double sum = 0;
  std::uint64_t count = 0;
  for (std::uint64_t frame = level.frames() * 6 / 10; frame < level.frames(); ++frame, ++count)
    sum += level.frame(frame).array<double>("probe")[6];
  EXPECT_NEAR(sum / static_cast<double>(count), 0.15, 0.01);
  EXPECT_THAT(redrive("level.h5", "1").out, testing::HasSubstr("identical"));
}

TEST_F(PythonExample, ASweepIsATableAndAPicture) {
  const std::string table = example("sweep_density.py depth.png --spacing 0.022 --until 0.2");
  const std::regex row(R"((\d+) +FINISHED .* ([0-9.]+) +([0-9.]+)\n)");
  std::vector<double> deepest;
  for (std::sregex_iterator match(table.begin(), table.end(), row), end; match != end; ++match)
    deepest.push_back(std::stod((*match)[2]));
  ASSERT_EQ(deepest.size(), 3u) << table;
  EXPECT_GT(deepest[0], deepest[1]);  // the lighter, the less deep
  EXPECT_GT(deepest[1], deepest[2]);
  EXPECT_EQ(bytes("depth.png").substr(1, 3), "PNG");
}

}  // namespace
}  // namespace sluice::test
