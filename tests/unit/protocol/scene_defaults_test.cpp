#include <gmock/gmock.h>

#include <cmath>

#include "protocol/scene_check.hpp"
#include "scene_text.hpp"

namespace sluice::protocol {
namespace {

using testing::ElementsAre;

Scene filled(const std::vector<std::string>& overrides = {}) {
  const TemporaryDirectory directory;
  return with_defaults(SceneFile::load(directory.write("a.scene", kScene), overrides).scene());
}

TEST(Defaults, AreThoseOfTheSceneDescription) {
  const Scene scene = filled();
  EXPECT_THAT(scene.gravity(), ElementsAre(0, -9.81));
  EXPECT_THAT(scene.domain().min(), ElementsAre(0, 0));
  EXPECT_EQ(scene.liquid().density(), 1000);
  EXPECT_DOUBLE_EQ(scene.output().rate(), 100 / 1.5);
  EXPECT_TRUE(scene.fluid(0).hydrostatic());
  EXPECT_EQ(scene.formulation().smoothing(), 1.45);
  EXPECT_EQ(scene.formulation().density_diffusion(), 0.1);
  EXPECT_EQ(scene.formulation().artificial_viscosity(), 0.02);
  EXPECT_EQ(scene.formulation().moment_floor(), 0.2);
  EXPECT_TRUE(scene.body(0).orientation().empty());  // an angle turns a body in two dimensions
}

// Liquid with nothing around it is kept from tearing under its own tension.
TEST(Defaults, ShiftingFollowsWhatHoldsTheLiquid) {
  const std::vector<std::string> flight{"gravity=[0, 0]", "domain.open=[X_MIN, X_MAX, Y_MIN, Y_MAX]",
                                        "body=[]", "liquid.max_speed=1"};
  EXPECT_EQ(filled(flight).formulation().shifting(), 16);
  EXPECT_TRUE(filled(flight).formulation().tension_control());
  std::vector<std::string> held = flight;
  held[1] = "domain.open=[X_MIN, X_MAX, Y_MAX]";
  EXPECT_EQ(filled(held).formulation().shifting(), 0);
  EXPECT_FALSE(filled(held).formulation().tension_control());
  std::vector<std::string> sph = flight;
  sph.push_back("formulation.approximation=SPH");
  EXPECT_EQ(filled(sph).formulation().shifting(), 0);
  EXPECT_FALSE(filled(sph).formulation().tension_control());
  std::vector<std::string> forced = flight;
  forced.push_back("formulation.boundary=FORCES");
  EXPECT_FALSE(filled(forced).formulation().tension_control());
  EXPECT_TRUE(check_fields(filled(forced)).empty());
  EXPECT_TRUE(check_fields(filled(flight)).empty());
}

// A recorded scene has its defaults filled in and is checked again when it is run again.
TEST(Defaults, PassTheChecks) {
  EXPECT_TRUE(check_fields(filled()).empty());
  EXPECT_TRUE(check_fields(filled({"body[0].prescribed={constant {velocity: [0, 1]}}"})).empty());
}

TEST(Defaults, OfInitialFieldsPassTheChecks) {
  const Scene scene = filled({"fluid[0].pressure=1", "fluid[0].velocity_field.x=y", "liquid.max_speed=1"});
  EXPECT_TRUE(check_fields(scene).empty());
  EXPECT_FALSE(scene.fluid(0).hydrostatic());
  EXPECT_TRUE(scene.fluid(0).velocity().empty());
}

TEST(Defaults, LeaveWhatIsGiven) {
  const Scene scene = filled({"gravity=[0, 0]", "liquid.max_speed=2", "liquid.density=0.5", "output.rate=7",
                              "fluid[0].hydrostatic=false", "formulation.smoothing=2"});
  EXPECT_THAT(scene.gravity(), ElementsAre(0, 0));
  EXPECT_EQ(scene.liquid().viscosity(), 1e-3);
  EXPECT_EQ(scene.liquid().density(), 0.5);
  EXPECT_EQ(scene.liquid().sound_speed(), 20);
  EXPECT_EQ(scene.output().rate(), 7);
  EXPECT_FALSE(scene.fluid(0).hydrostatic());
  EXPECT_EQ(scene.formulation().smoothing(), 2);
}

TEST(Defaults, SpeedFollowsFromTheHighestLiquid) {
  EXPECT_DOUBLE_EQ(filled().liquid().max_speed(), std::sqrt(2 * 9.81 * 0.3));
  EXPECT_DOUBLE_EQ(filled().liquid().sound_speed(), 10 * std::sqrt(2 * 9.81 * 0.3));
  EXPECT_DOUBLE_EQ(filled({"domain.min=[0, -0.1]"}).liquid().max_speed(), std::sqrt(2 * 9.81 * 0.4));
}

TEST(Defaults, SpeedFollowsGravityInAnyDirection) {
  EXPECT_DOUBLE_EQ(filled({"gravity=[-2, 0]", "fluid[0].box.max=[0.4, 0.1]"}).liquid().max_speed(),
                   std::sqrt(2 * 2 * 0.4));
  EXPECT_DOUBLE_EQ(filled({"gravity=[2, 0]", "fluid[0].box.max=[0.4, 0.1]"}).liquid().max_speed(),
                   std::sqrt(2 * 2 * 1.0));
}

TEST(Defaults, SpeedOfShapesOtherThanBoxes) {
  EXPECT_DOUBLE_EQ(filled({"fluid[0]={ball {center: [0.3, 0.2] radius: 0.15}}"}).liquid().max_speed(),
                   std::sqrt(2 * 9.81 * 0.35));
  EXPECT_DOUBLE_EQ(
      filled({"fluid[0]={polygon {vertex {} vertex {x: 0.2} vertex {y: 0.25}}}"}).liquid().max_speed(),
      std::sqrt(2 * 9.81 * 0.25));
}

TEST(Defaults, FasterInitialSpeedCounts) {
  EXPECT_DOUBLE_EQ(filled({"fluid[0].velocity=[3, 4]"}).liquid().max_speed(), 5);
  EXPECT_DOUBLE_EQ(filled({"fluid[0].velocity=[3, 4]", "gravity=[0, 0]"}).liquid().max_speed(), 5);
  const Liquid tense = filled({"liquid.surface_tension=10", "gravity=[0, 0]", "spacing=0.001"}).liquid();
  EXPECT_DOUBLE_EQ(tense.max_speed(), std::sqrt(10 / (tense.density() * 0.001)));
}

TEST(Defaults, SpeedFollowsFromTheSpeedOfSoundWhereNothingElseMoves) {
  EXPECT_DOUBLE_EQ(filled({"gravity=[0, 0]", "liquid.sound_speed=30"}).liquid().max_speed(), 3);
}

// What a peer sends is not always checked before.
TEST(Defaults, ScenesThatLackEverythingDoNoHarm) {
  Scene scene;
  scene.add_fluid()->mutable_box();
  scene.add_fluid()->mutable_polygon()->add_vertex();
  scene.mutable_gravity()->Add(-1);
  scene.add_body();
  const Scene full = with_defaults(scene);
  EXPECT_THAT(full.body(0).velocity(), ElementsAre(0, 0));
  EXPECT_EQ(full.liquid().max_speed(), 0);
}

}  // namespace
}  // namespace sluice::protocol
