// The scenes of `sluice bench stability --case random_scenes`: fit to run, the same everywhere, and a few of
// them run. Those that fail are no test here; the benchmark names them.
#include <gtest/gtest.h>

#include "benchmark/escapes.hpp"
#include "benchmark/follow.hpp"
#include "benchmark/random_scene.hpp"
#include "clients/preflight/preflight.hpp"
#include "tests/cli/command.hpp"
#include "validation/support/files.hpp"

namespace sluice::benchmark {
namespace {

TEST(RandomScene, IsTheSameForTheSameSeed) {
  EXPECT_EQ(random_scene(7).SerializeAsString(), random_scene(7).SerializeAsString());
  EXPECT_NE(random_scene(7).SerializeAsString(), random_scene(8).SerializeAsString());
}

TEST(RandomScene, PassesEveryCheck) {
  const test::TemporaryDirectory directory;
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    write_scene(random_scene(seed), seed, directory.path());
    const auto path = directory.path() / ("seed_" + std::to_string(seed) + ".scene");
    for (const auto& error : clients::preflight(protocol::SceneFile::load(path)).errors)
      ADD_FAILURE() << protocol::to_string(error);
  }
}

TEST(RandomScene, HasEverythingInSome) {
  int spatial = 0, open = 0, drops = 0, gates = 0, floating = 0, heavy = 0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const Scene scene = random_scene(seed);
    spatial += scene.dimension() == 3;
    open += scene.domain().open_size() > 0;
    for (const FluidRegion& region : scene.fluid()) drops += region.has_ball();
    for (const Body& body : scene.body()) {
      gates += body.has_prescribed();
      floating += body.has_density() && body.density() < 200;
      heavy += body.density() > 5000;
    }
  }
  for (const int count : {spatial, open, drops, gates, floating, heavy}) EXPECT_GE(count, 5);
}

class Sound : public testing::TestWithParam<std::uint64_t> {};

TEST_P(Sound, ToTheEnd) {
  validation::SceneRun run(random_scene(GetParam()));
  const Faults faults = follow(run);
  EXPECT_FALSE(faults.any()) << faults.text();
}

// Seeds with bodies, gates, drops, lids and none, in the plane and in space.
// In 137 liquid is pressed against a wall in space; 311 and 353 start with a jump of velocity.
INSTANTIATE_TEST_SUITE_P(Seed, Sound,
                         testing::Values(2, 3, 4, 5, 6, 7, 8, 9, 10, 13, 22, 26, 27, 49, 56, 137, 311, 353));

TEST(Follow, SeesARunBlowUp) {
  validation::SceneRun run(validation::shipped_scene("dam_break"),
                           {"spacing=0.0028575", "formulation.courant=1"});
  EXPECT_TRUE(follow(run).any());
}

// A tank of 1 m without a lid, particles 0.1 m apart; one particle.
class TrackedParticle : public testing::Test {
 protected:
  TrackedParticle() : escapes_(tank()) {}

  static Scene tank() {
    Scene scene;
    scene.set_dimension(2);
    scene.set_spacing(0.1);
    for (int a = 0; a < 2; ++a) {
      scene.mutable_domain()->add_min(0);
      scene.mutable_domain()->add_max(1);
    }
    scene.mutable_domain()->add_open(Y_MAX);
    return scene;
  }
  std::uint64_t lost_at(double x, double y) {
    escapes_.follow({.position = {x, y, 0},
                     .velocity = {0, 0, 0},
                     .density = {1000},
                     .pressure = {0},
                     .id = {0},
                     .liquid = {}});
    return escapes_.lost();
  }

  Escapes escapes_;
};

TEST_F(TrackedParticle, IsLostMoreThanASpacingBehindAWall) {
  EXPECT_EQ(lost_at(0.5, 0.5), 0u);
  EXPECT_EQ(lost_at(1.09, 0.5), 0u);
  EXPECT_EQ(lost_at(1.11, 0.5), 1u);
  EXPECT_EQ(lost_at(0.5, 0.5), 1u);  // for good
}

TEST_F(TrackedParticle, MayGoAnywhereThroughTheOpenSide) {
  EXPECT_EQ(lost_at(0.9, 1.01), 0u);
  EXPECT_EQ(lost_at(1.5, -3), 0u);
}

}  // namespace
}  // namespace sluice::benchmark
