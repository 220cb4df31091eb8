#include "clients/sluice/summary.hpp"

#include <gmock/gmock.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "clients/sluice/not_computed.hpp"

namespace sluice::clients {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

Summary finished() {
  Summary summary;
  summary.scene = "gate";
  summary.file = "gate.scene";
  summary.fluid_particles = 10'000;
  summary.step = summary.steps = 500;
  summary.time = summary.duration = 0.3;
  summary.wall_seconds = 2;
  summary.status = "FINISHED";
  return summary;
}

TEST(Summary, SpeedCountsParticlesTimesSteps) {
  EXPECT_DOUBLE_EQ(finished().particle_steps_per_second(), 2.5e6);
  EXPECT_EQ(Summary{}.particle_steps_per_second(), 0);
}

TEST(Summary, EnergyIsPerMetreInTwoDimensions) {
  Summary summary = finished();
  summary.start.emplace().set_potential(49.05);
  EXPECT_THAT(to_table(summary), HasSubstr("49.05 J/m"));
  summary.dimension = 3;
  EXPECT_THAT(to_table(summary), HasSubstr("49.05 J ("));
}

TEST(Summary, WhatIsNotKnownIsLeftOut) {
  EXPECT_THAT(to_table(finished()), Not(HasSubstr("energy")));
  EXPECT_THAT(to_table(finished()), Not(HasSubstr("recording")));
  const json object = json::parse(to_json(finished()));
  EXPECT_TRUE(object.at("energy").at("start").is_null());
  EXPECT_TRUE(object.at("recording").is_null());
}

TEST(Summary, SaysWhatTheSceneDidWithout) {
  Scene scene;
  scene.set_dimension(2);
  scene.mutable_liquid()->set_viscosity(1e-3);
  scene.add_body();
  Summary summary = finished();
  summary.not_computed = not_computed(scene, true);
  EXPECT_THAT(to_table(summary),
              HasSubstr("not computed        third dimension, surface tension, second liquid"));
  EXPECT_THAT(summary.not_computed, Not(testing::Contains(testing::AnyOf("viscosity", "bodies", "frames"))));
  EXPECT_EQ(json::parse(to_json(summary)).at("not_computed").size(), summary.not_computed.size());
  scene.add_other_liquid()->set_viscosity(1e-3);
  scene.mutable_liquid()->clear_viscosity();
  EXPECT_THAT(not_computed(scene, false), testing::Not(testing::Contains("viscosity")));
  EXPECT_THAT(not_computed(scene, false), testing::Contains("frames"));
}

TEST(Summary, JsonStaysJsonWhateverTheNamesAndNumbers) {
  Summary summary = finished();
  summary.scene = "say \"\n\xff\"";
  summary.end.emplace().set_kinetic(std::numeric_limits<double>::quiet_NaN());
  const json object = json::parse(to_json(summary));
  EXPECT_TRUE(object.at("energy").at("end").at("kinetic").is_null());
}

}  // namespace
}  // namespace sluice::clients
