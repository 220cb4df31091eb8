#include "server/stability.hpp"

#include <gmock/gmock.h>

#include "protocol/scene_check.hpp"
#include "server/simulation.hpp"
#include "tests/coupling/scenes.hpp"

namespace sluice::testing {
namespace {

using ::testing::HasSubstr;

server::CouplingPlan plan(CouplingScheme scheme, double density, double step) {
  Scene scene = ball();
  scene.mutable_coupling()->set_scheme(scheme);
  scene.mutable_body(0)->set_density(density);
  scene = protocol::with_defaults(scene);
  return server::plan_coupling(scene, server::to_setup(scene, 1), step);
}

// 2 rho0 c0 D dt/m for a disc of 0.4 m at c0 = 40 m/s.
TEST(Stability, IndicatorIsImpedanceTimesTimeOverMass) {
  const double mass = 500 * M_PI * 0.04;
  EXPECT_NEAR(plan(EXPLICIT, 500, 1e-3).stability.at(0).indicator(), 2 * 1000 * 40 * 0.4 * 1e-3 / mass,
              0.02 * 2 * 1000 * 40 * 0.4 * 1e-3 / mass);
}

TEST(Stability, AutoIteratesWhereABodyIsTooLight) {
  EXPECT_EQ(plan(AUTO, 2000, 1e-3).coupling.scheme(), EXPLICIT);
  EXPECT_EQ(plan(AUTO, 20, 1e-3).coupling.scheme(), IMPLICIT);
  EXPECT_EQ(plan(AUTO, 2000, 1e-1).coupling.scheme(), IMPLICIT);
}

TEST(Stability, WarnsOfTheBodyWithValueAndWhatIsAllowed) {
  const Scene scene = ball();
  const auto warnings = server::stability_warnings(scene, plan(EXPLICIT, 20, 1e-3));
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_THAT(warnings[0], HasSubstr("body 'ball'"));
  EXPECT_THAT(warnings[0], HasSubstr("is 12."));
  EXPECT_THAT(warnings[0], HasSubstr("0.5"));
  EXPECT_TRUE(server::stability_warnings(scene, plan(EXPLICIT, 2000, 1e-3)).empty());
  EXPECT_TRUE(server::stability_warnings(scene, plan(IMPLICIT, 20, 1e-3)).empty());
}

// Explicit exchanges shorten the fluid's step unless told not to; implicit ones never do.
TEST(Stability, OnlyTheExplicitSchemeShortensSteps) {
  Scene scene = ball();
  scene.mutable_body(0)->set_density(20);
  const auto steps = [&] { return server::make_simulation(scene, 1).clock.steps(); };
  const std::uint64_t shortened = steps();
  scene.mutable_coupling()->set_shorten_steps(false);
  const std::uint64_t acoustic = steps();
  scene.mutable_coupling()->clear_shorten_steps();
  scene.mutable_coupling()->set_scheme(IMPLICIT);
  EXPECT_EQ(steps(), acoustic);
  EXPECT_GT(shortened, 5 * acoustic);
  scene.mutable_coupling()->set_scheme(EXPLICIT);
  scene.mutable_coupling()->set_steps_per_exchange(4);
  EXPECT_GT(steps(), 3 * shortened);
}

}  // namespace
}  // namespace sluice::testing
