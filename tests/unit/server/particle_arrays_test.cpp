#include "server/particle_arrays.hpp"

#include <gtest/gtest.h>

#include "protocol/frame_layout.hpp"

namespace sluice::server {
namespace {

using Shape = std::vector<std::uint64_t>;

// Four particles in a row along x, at 0.1, 0.2, 0.3 and 0.4 m.
fluid::Snapshot row() {
  fluid::Snapshot state;
  for (int i = 0; i < 4; ++i) {
    const double x = 0.1 * (i + 1);
    state.position.insert(state.position.end(), {x, 0.05, 0});
    state.velocity.insert(state.velocity.end(), {x + 1, x + 2, 0});
    state.density.push_back(1000 + i);
    state.pressure.push_back(1.0 / (3 + i));
    state.id.push_back(static_cast<std::uint32_t>(i));
  }
  return state;
}

protocol::Message frame(const Output& output) {
  Scene scene;
  *scene.mutable_output() = output;
  protocol::Message message;
  add_particles(message, scene, row());
  return message;
}

std::vector<std::string> names(const protocol::Message& message) {
  std::vector<std::string> names;
  for (const Array& array : message.header.array()) names.push_back(array.name());
  return names;
}

TEST(ParticleArrays, AreAllFieldsOfAllParticlesByDefault) {
  const protocol::Message message = frame({});
  EXPECT_EQ(names(message), (std::vector<std::string>{"fluid/position", "fluid/velocity", "fluid/density",
                                                      "fluid/pressure"}));
  EXPECT_EQ(message.shape("fluid/position"), (Shape{4, 3}));
  const auto pressure = message.array<double>("fluid/pressure");
  EXPECT_EQ(std::vector<double>(pressure.begin(), pressure.end()), row().pressure);
}

// What comes in through an opening has a number of its own, and so has what stays when others leave.
TEST(ParticleArrays, HoldTheNumbersWhereLiquidComesAndGoes) {
  Scene scene;
  scene.add_opening();
  fluid::Snapshot state = row();
  state.id = {0, 3, 4, 9};
  protocol::Message message;
  add_particles(message, scene, state);
  const auto all = message.array<std::int64_t>("fluid/id");
  EXPECT_EQ(std::vector<std::int64_t>(all.begin(), all.end()), (std::vector<std::int64_t>{0, 3, 4, 9}));
  Span& region = *scene.mutable_output()->mutable_region();
  for (const double x : {0.15, 0.0}) region.add_min(x);
  for (const double x : {0.35, 1.0}) region.add_max(x);
  protocol::Message selected;
  add_particles(selected, scene, state);
  const auto some = selected.array<std::int64_t>("fluid/id");
  EXPECT_EQ(std::vector<std::int64_t>(some.begin(), some.end()), (std::vector<std::int64_t>{3, 4}));
}

TEST(ParticleArrays, HoldThePositionWhateverIsAskedFor) {
  Output output;
  output.add_field(PRESSURE);
  EXPECT_EQ(names(frame(output)), (std::vector<std::string>{"fluid/position", "fluid/pressure"}));
}

TEST(ParticleArrays, RoundToSinglePrecisionWhereAskedTo) {
  Output output;
  output.set_precision(FLOAT32);
  const protocol::Message message = frame(output);
  EXPECT_EQ(message.array<float>("fluid/pressure")[0], 1.0F / 3);
  EXPECT_EQ(message.frames[0].size(), 4u * 3 * 4);
}

TEST(ParticleArrays, AreOfTheParticlesInTheRegion) {
  Output output;
  for (const double x : {0.2, 0.0}) output.mutable_region()->add_min(x);
  for (const double x : {0.35, 1.0}) output.mutable_region()->add_max(x);
  for (const Precision precision : {FLOAT64, FLOAT32}) {
    output.set_precision(precision);
    const protocol::Message message = frame(output);
    const auto ids = message.array<std::int64_t>(protocol::kParticleId);
    EXPECT_EQ(std::vector<std::int64_t>(ids.begin(), ids.end()), (std::vector<std::int64_t>{1, 2}));
    EXPECT_EQ(message.shape("fluid/velocity"), (Shape{2, 3}));
    EXPECT_EQ(message.shape("fluid/density"), (Shape{2}));
    const double first_y = precision == FLOAT32 ? message.array<float>("fluid/velocity")[1]
                                                : message.array<double>("fluid/velocity")[1];
    EXPECT_NEAR(first_y, 2.2, 1e-6);
  }
}

TEST(ParticleArrays, MayBeEmpty) {
  Output output;
  for (const double x : {5.0, 5.0}) output.mutable_region()->add_min(x);
  for (const double x : {6.0, 6.0}) output.mutable_region()->add_max(x);
  EXPECT_EQ(frame(output).shape("fluid/position"), (Shape{0, 3}));
}

}  // namespace
}  // namespace sluice::server
