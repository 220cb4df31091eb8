#include <gmock/gmock.h>

#include <cmath>

#include "protocol/frame_layout.hpp"
#include "protocol/liquids.hpp"
#include "protocol/scene_check.hpp"
#include "scene_text.hpp"

namespace sluice::protocol {
namespace {

using testing::HasSubstr;

constexpr const char* kOil = "other_liquid { name: 'oil' density: 250 }";
constexpr const char* kRegion = " fluid { box { min: [0.7, 0] max: [0.9, 0.2] } liquid: 'oil' }";

std::string errors(const std::string& more) {
  return errors_of(with_line(5, "liquid { max_speed: 3 }" + more));
}

TEST(Liquids, SeveralPass) {
  EXPECT_EQ(errors(std::string(kOil) + kRegion), "");
  EXPECT_EQ(errors(std::string(kOil) + kRegion + " output { field: LIQUID }"), "");
}

TEST(Liquids, SeveralHaveNoSurfaceTension) {
  const std::string tense = "liquid { max_speed: 3 surface_tension: 0.07 }";
  EXPECT_EQ(errors_of(with_line(5, tense)), "");
  EXPECT_THAT(errors_of(with_line(5, tense + kOil + kRegion)),
              HasSubstr("liquid.surface_tension: is built for the free surface of one liquid; leave it out"));
}

struct Wrong {
  std::string text, error;
};

TEST(Liquids, WrongOnesAreReportedWithTheirPlace) {
  const std::string both = std::string(kOil) + kRegion;
  for (const auto& [text, error] :
       {Wrong{kOil, "other_liquid[0]: no region is of it; give one liquid: \"oil\", or remove it"},
        Wrong{kRegion, "no other_liquid is named \"oil\"; add one, or leave it out"},
        Wrong{"other_liquid { name: 'air' density: 1 }" + std::string(kRegion),
              "no other_liquid is named \"oil\"; they are air"},
        Wrong{"other_liquid { density: 1 }", "other_liquid[0].name: is missing"},
        Wrong{both + kOil, "other_liquid[1].name: \"oil\" is taken"},
        Wrong{"other_liquid { name: 'oil' }" + std::string(kRegion),
              "other_liquid[0].density: 0 kg/m^3 is not positive"},
        Wrong{"other_liquid { name: 'oil' density: 250 viscosity: -1 }" + std::string(kRegion),
              "other_liquid[0].viscosity: -1 Pa s is negative"},
        Wrong{"other_liquid { name: 'oil' density: 0.9 }" + std::string(kRegion),
              "1000 kg/m^3 is 1111 times as heavy as 0.9 kg/m^3; at most 1000 times"},
        Wrong{both + " opening { name: 'a' side: X_MIN outflow { } }", "opening: what comes in and leaves"},
        Wrong{both + " formulation { approximation: SHEPARD }", "formulation.approximation: several liquids"},
        Wrong{both + " formulation { shifting: 3 }", "formulation.shifting: carries momentum"},
        Wrong{both + " formulation { mass: LUMPED }", "formulation.mass: LUMPED smears"}})
    EXPECT_THAT(errors(text), HasSubstr(error)) << text;
  EXPECT_THAT(errors(" output { field: LIQUID }"), HasSubstr("LIQUID is the same for all particles"));
}

TEST(Liquids, AreEquallyStiffAndTheHeaviestHasTenTimesTheSpeed) {
  Scene scene;
  scene.mutable_liquid()->set_max_speed(2);
  OtherLiquid& mercury = *scene.add_other_liquid();
  mercury.set_name("mercury");
  mercury.set_density(16000);
  const Scene full = with_defaults(scene);
  EXPECT_DOUBLE_EQ(full.liquid().sound_speed(), 80);
  const auto all = liquids(full);
  ASSERT_EQ(all.size(), 2u);
  EXPECT_DOUBLE_EQ(all[1].sound_speed, 20);
  EXPECT_DOUBLE_EQ(slowest_sound(full), 20);
  EXPECT_DOUBLE_EQ(fastest_sound(full), 80);
}

TEST(Liquids, AreTheLastArrayOfParticles) {
  Scene scene;
  EXPECT_EQ(particle_arrays(scene).back().name, "fluid/pressure");
  scene.add_other_liquid();
  EXPECT_EQ(particle_arrays(scene).back().name, "fluid/liquid");
  EXPECT_EQ(particle_arrays(scene).back().type, Array::INT64);
  scene.mutable_output()->add_field(PRESSURE);
  EXPECT_EQ(particle_arrays(scene).back().name, "fluid/pressure");
}

}  // namespace
}  // namespace sluice::protocol
