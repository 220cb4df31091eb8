#include <gtest/gtest.h>

#include <fmt/format.h>

#include <cmath>

#include "server/stop.hpp"
#include "validation/support/files.hpp"
#include "validation/support/scene_run.hpp"

namespace sluice::validation {
namespace {

// Drops in at 2 m/s from a hand's breadth above: nothing may ever be faster than twice that, nor may energy
// appear.
void expect_stable(const std::string& scene, double density) {
  SCOPED_TRACE(fmt::format("{} of {} kg/m^3", scene, density));
  SceneRun run(case_file("light_bodies/" + scene + ".scene"), {fmt::format("body[0].density={}", density)});
  double fastest = 0;
  ASSERT_NO_THROW({
    while (run.next_step()) fastest = std::max(fastest, run.body(0).velocity.norm());
  });
  EXPECT_LT(fastest, 4);
  std::printf("%s of %g kg/m^3: %s, %.2f iterations an exchange, fastest %.2f m/s\n", scene.c_str(), density,
              run.simulation().is_iterated() ? "implicit" : "explicit",
              static_cast<double>(run.iterations()) / static_cast<double>(run.exchanges()), fastest);
}

TEST(LightBodies, AnyDensityIsStableWithAutoInThePlane) {
  for (const double density : {10.0, 50.0, 300.0, 1000.0, 20000.0}) expect_stable("box_drop", density);
}
TEST(LightBodies, AnyDensityIsStableWithAutoInSpace) {
  for (const double density : {10.0, 20000.0}) expect_stable("sphere_drop", density);
}

// The explicit scheme on a submerged box: stable up to `stable`, and not at `unstable` (README.md of the
// server has the table).
bool is_stable(int steps, double indicator) {
  const auto overrides = [&](double density) {
    return std::vector<std::string>{fmt::format("coupling.steps_per_exchange={}", steps),
                                    "coupling.scheme=EXPLICIT", "coupling.shorten_steps=false",
                                    fmt::format("body[0].density={}", density)};
  };
  const auto file = case_file("light_bodies/submerged_box.scene");
  const double at_1000 = SceneRun(file, overrides(1000)).simulation().coupling.stability[0].indicator();
  SceneRun run(file, overrides(1000 * at_1000 / indicator));
  try {
    while (run.next_step())
      if (run.body(0).velocity.norm() > 1) return false;
  } catch (const server::Stop&) {
    return false;
  } catch (const std::runtime_error&) {
    return false;
  }
  return true;
}

TEST(LightBodies, TheIndicatorTellsWhereTheExplicitSchemeIsStable) {
  for (const int steps : {1, 4, 16, 64}) {
    SCOPED_TRACE(steps);
    EXPECT_TRUE(is_stable(steps, 0.5));
    EXPECT_TRUE(steps == 1 || !is_stable(steps, 20));
  }
}

}  // namespace
}  // namespace sluice::validation
