#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

#include "scene_text.hpp"

namespace sluice::protocol {
namespace {

using testing::ElementsAre;

Scene load_with(const std::vector<std::string>& overrides) {
  const TemporaryDirectory directory;
  return SceneFile::load(directory.write("a.scene", kScene), overrides).scene();
}

TEST(Override, SetsNumbersTextsAndChoices) {
  EXPECT_EQ(load_with({"spacing=0.002"}).spacing(), 0.002);
  EXPECT_EQ(load_with({"body[0].density=250"}).body(0).density(), 250);
  EXPECT_EQ(load_with({"name=two words"}).name(), "two words");
  EXPECT_EQ(load_with({"name=\"quo\\\"ted\""}).name(), "quo\"ted");
  EXPECT_TRUE(load_with({"body[0].displaces_fluid=true"}).body(0).displaces_fluid());
  EXPECT_THAT(load_with({"domain.open=[Y_MAX]"}).domain().open(), ElementsAre(Y_MAX));
}

TEST(Override, MakesWhatTheFileLeavesOut) {
  EXPECT_EQ(load_with({"output.rate=50"}).output().rate(), 50);
  EXPECT_THAT(load_with({"gravity=[0, -1.62]"}).gravity(), ElementsAre(0, -1.62));
}

TEST(Override, ChangesEntriesOfLists) {
  EXPECT_THAT(load_with({"body[0].position[1]=0.31"}).body(0).position(), ElementsAre(0.5, 0.31));
  EXPECT_THAT(load_with({"body[1].prescribed.keyframes.key[1].offset=[0, 0.2]"})
                  .body(1)
                  .prescribed()
                  .keyframes()
                  .key(1)
                  .offset(),
              ElementsAre(0, 0.2));
  EXPECT_THAT(load_with({"gravity[0]=0", "gravity[1]=-2"}).gravity(), ElementsAre(0, -2));
}

TEST(Override, TakesMessages) {
  EXPECT_EQ(load_with({"liquid={density: 900}"}).liquid().density(), 900);
  EXPECT_FALSE(load_with({"liquid={density: 900}"}).liquid().has_viscosity());
  EXPECT_EQ(
      load_with({"body[2]={name: \"c\" ball {radius: 0.01} density: 10 position: [0.7, 0.4]}"}).body_size(),
      3);
}

TEST(Override, LastOneWins) {
  EXPECT_EQ(load_with({"spacing=0.1", "spacing=0.02"}).spacing(), 0.02);
}

struct Bad {
  const char* assignment;
  const char* error;
};

class OverrideRefuses : public testing::TestWithParam<Bad> {};

TEST_P(OverrideRefuses, AndNamesThePath) {
  EXPECT_EQ(errors_of(kScene, {GetParam().assignment}),
            std::string("--set ") + GetParam().assignment + ": " + GetParam().error);
}

INSTANTIATE_TEST_SUITE_P(
    Overrides, OverrideRefuses,
    testing::Values(
        Bad{"spacng=1", "spacng: the scene has no field \"spacng\"; did you mean spacing?"},
        Bad{"body[0].densty=1", "body[0].densty: body[0] has no field \"densty\"; did you mean density?"},
        Bad{"liquid.zzzzzzz=1",
            "liquid.zzzzzzz: liquid has no field \"zzzzzzz\"; it has density, viscosity, sound_speed, "
            "max_speed, surface_tension"},
        Bad{"body[7].density=1", "body[7].density: body[7] does not exist; the scene has indices 0 to 1"},
        Bad{"gravity[1]=1", "gravity[1]: gravity[1] does not exist; the scene has none"},
        Bad{"body.density=1", "body.density: body is a list; write body[0] for its first entry"},
        Bad{"liquid[0].density=1", "liquid[0].density: liquid is not a list; leave out [0]"},
        Bad{"spacing[0]=1", "spacing[0]: spacing is not a list; leave out [0]"},
        Bad{"spacing.x=1", "spacing.x: spacing is a value and has no fields"},
        Bad{"body[x].mass=1", "body[x].mass: body[x]: an index is written [0], [1] ..."},
        Bad{"body[-1].mass=1", "body[-1].mass: body[-1]: an index is written [0], [1] ..."},
        Bad{"body[0]mass=1", "body[0]mass: body[0]mass: an index is written [0], [1] ..."},
        Bad{"body[0].ball.radius=1",
            "body[0].ball.radius: box is given, not ball; an override can change its fields but not the "
            "shape"},
        Bad{"spacing",
            "spacing: an override is written PATH=VALUE, e.g. spacing=0.002 or body[0].density=500"},
        Bad{"=1", "an override is written PATH=VALUE, e.g. spacing=0.002 or body[0].density=500"},
        Bad{"spacing=", "spacing: \"\" is not a number"},
        Bad{"spacing=small", "spacing: \"small\" is not a number"},
        Bad{"spacing=1 duration: 9", "spacing: \"1 duration: 9\" is not a number"},
        Bad{"gravity=[1] spacing: 9",
            "gravity: \"[1] spacing: 9\" is not a list [a, b ...] whose entries are a number"},
        Bad{"dimension=2.5", "dimension: \"2.5\" is not a number"},
        Bad{"body[0].displaces_fluid=perhaps", "body[0].displaces_fluid: \"perhaps\" is not true or false"},
        Bad{"domain.open[0]=SKY",
            "domain.open[0]: \"SKY\" is not one of SIDE_UNSPECIFIED, X_MIN, X_MAX, Y_MIN, Y_MAX, Z_MIN, "
            "Z_MAX"},
        Bad{"spacing=-0.1", "spacing: -0.1 m is not positive; give the distance between particles"},
        Bad{"spacing=nan", "spacing: nan is not a finite number"}));

RC_GTEST_PROP(OverrideFuzz, NeverCrashes, (const std::string& path, const std::string& value)) {
  const std::string start =
      *rc::gen::element<std::string>("", "body[0].", "body[", "liquid.", "gravity[0]", "body[1].prescribed.");
  (void)errors_of(kScene, {start + path + "=" + value});
  RC_ASSERT(errors_of(kScene, {start + path}) != "");
}

}  // namespace
}  // namespace sluice::protocol
