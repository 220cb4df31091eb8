#include "protocol/frame_layout.hpp"

#include <gtest/gtest.h>

#include "protocol/scene_check.hpp"

namespace sluice::protocol {
namespace {

std::vector<std::string> names(const Scene& scene) {
  std::vector<std::string> names;
  for (const ParticleArray& array : particle_arrays(scene)) names.push_back(array.name);
  return names;
}

const std::vector<std::string> kAll{"fluid/position", "fluid/velocity", "fluid/density", "fluid/pressure"};

// Recordings of before there was a choice have scenes that say nothing of it.
TEST(FrameLayout, AnEmptyOutputIsEverythingInEveryFrame) {
  const Scene scene;
  EXPECT_EQ(names(scene), kAll);
  EXPECT_EQ(particle_arrays(scene)[0].type, Array::FLOAT64);
  EXPECT_FALSE(particles_vary(scene));
  EXPECT_TRUE(has_particles(scene, 7));
}

TEST(FrameLayout, TheDefaultsAreTheSame) {
  Scene scene;
  scene.set_dimension(2);
  scene.set_duration(1);
  EXPECT_EQ(names(with_defaults(scene)), kAll);
  EXPECT_EQ(particles_every(with_defaults(scene)), 1u);
}

TEST(FrameLayout, ARegionBringsIdentities) {
  Scene scene;
  scene.mutable_output()->mutable_region();
  scene.mutable_output()->add_field(DENSITY);
  scene.mutable_output()->set_precision(FLOAT32);
  EXPECT_EQ(names(scene), (std::vector<std::string>{"fluid/id", "fluid/position", "fluid/density"}));
  EXPECT_EQ(particle_arrays(scene)[0].type, Array::INT64);
  EXPECT_EQ(particle_arrays(scene)[2].type, Array::FLOAT32);
}

TEST(FrameLayout, ParticlesComeInEveryNthOutput) {
  Scene scene;
  scene.mutable_output()->set_particles_every(3);
  for (const std::uint64_t output : {0, 3, 6}) EXPECT_TRUE(has_particles(scene, output));
  for (const std::uint64_t output : {1, 2, 4}) EXPECT_FALSE(has_particles(scene, output));
}

}  // namespace
}  // namespace sluice::protocol
