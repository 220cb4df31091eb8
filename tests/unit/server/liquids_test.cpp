#include <gtest/gtest.h>

#include "scene_text.hpp"
#include "server/liquid.hpp"
#include "server/particle_arrays.hpp"
#include "server/simulation.hpp"

namespace sluice::testing {
namespace {

constexpr const char* kLayers =
    "other_liquid { name: 'oil' density: 250 viscosity: 0.1 } "
    "fluid { box { min: [0, 0] max: [1, 0.5] } } "
    "fluid { box { min: [0.3, 0.5] max: [1, 1] } liquid: 'oil' }";

TEST(SeveralLiquids, MakeASetupWithTheHeaviestAsReference) {
  const fluid::Setup setup =
      server::to_setup(tank_with("liquid { density: 100 } " + std::string(kLayers)), 1);
  ASSERT_EQ(setup.liquids.size(), 2u);
  EXPECT_EQ(setup.liquid.density, 250);
  EXPECT_EQ(setup.liquids[0].density, 100);
  EXPECT_EQ(setup.liquids[1].viscosity, 0.1);
  EXPECT_TRUE(setup.has_viscous_stress());
  EXPECT_NEAR(setup.liquid.sound_speed, 40, 1e-12);
  EXPECT_EQ(setup.fluid.liquid.front(), 0);
  EXPECT_EQ(setup.fluid.liquid.back(), 1);
  EXPECT_TRUE(server::to_setup(tank_with("fluid { box { max: [1, 0.5] min: [0, 0] } }"), 1).liquids.empty());
}

// With the speed of sound of the scene, 40 m/s, compression changes a pressure by less than 0.4 %.
TEST(SeveralLiquids, StandOnEachOtherHydrostatically) {
  const fluid::FluidParticles liquid = server::fill_liquid(tank_with(kLayers));
  for (std::size_t i = 0; i < liquid.position.size(); ++i) {
    const double x = liquid.position[i].x(), y = liquid.position[i].y();
    const double expected = y > 0.5   ? 250 * 9.81 * (1 - y)
                            : x > 0.3 ? 250 * 9.81 * 0.5 + 1000 * 9.81 * (0.5 - y)
                                      : 1000 * 9.81 * (0.5 - y);
    EXPECT_NEAR(liquid.pressure[i], expected, 4e-3 * expected) << x << ", " << y;
  }
}

TEST(SeveralLiquids, AreToldOfWithTheParticles) {
  const Scene scene = tank_with(kLayers);
  fluid::Snapshot state;
  state.position = {0, 0, 0, 1, 1, 0};
  state.velocity = state.position;
  state.density = state.pressure = {1, 2};
  state.id = {0, 1};
  state.liquid = {1, 0};
  protocol::Message message;
  server::add_particles(message, scene, state);
  const auto numbers = message.array<std::int64_t>("fluid/liquid");
  EXPECT_EQ(std::vector<std::int64_t>(numbers.begin(), numbers.end()), (std::vector<std::int64_t>{1, 0}));
}

}  // namespace
}  // namespace sluice::testing
