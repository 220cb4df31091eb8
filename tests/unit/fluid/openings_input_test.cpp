#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/fluid/streams.hpp"

namespace sluice::fluid {
namespace {

const auto kOne = [](double, const Eigen::Vector3d&) { return 1.0; };
const auto kHigh = [](double) { return 0.5; };

struct Case {
  const char* quantity;
  std::function<void(Opening& in, Opening& out, fluid::Setup&)> spoil;
};

TEST(OpeningsInput, IsRefusedByName) {
  for (const auto& [quantity, spoil] : {
           Case{"side of an opening is 4", [](Opening&in, Opening&, fluid::Setup&) { in.side = 4; }},
           Case{"side of an opening is 1",
                [](Opening&, Opening&, fluid::Setup&setup) { setup.mirrors.at[1] = true; }},
           Case{"side of an opening is 0",
                [](Opening&, Opening&, fluid::Setup&setup) { setup.period.length.x() = 2; }},
           Case{"size of an opening [m] is 0.05",
                [](Opening&in, Opening&, fluid::Setup&) { in.max.y() = 0.05; }},
           Case{"speed given at an opening is 0",
                [](Opening&in, Opening&, fluid::Setup&) { in.speed = nullptr; }},
           Case{"speed given at an opening is 1",
                [](Opening&, Opening&out, fluid::Setup&) { out.speed = kOne; }},
           Case{"pressure and level",
                [](Opening&, Opening&out, fluid::Setup&) { out.pressure = kOne, out.level = kHigh; }},
           Case{"gravity [m/s^2] is 0",
                [](Opening&, Opening&out, fluid::Setup&) { out.pressure = nullptr, out.level = kHigh; }},
           Case{"integrator is 1",
                [](Opening&, Opening&, fluid::Setup&setup) {
                  setup.formulation.integrator = Integrator::leap_frog;
                }},
       }) {
    Stream stream = Stream::closed(2, {2, 1, 0});
    spoil(stream.inflow(), stream.outflow(), stream.setup);
    try {
      make_solver(stream.setup);
      ADD_FAILURE() << quantity << " was taken";
    } catch (const std::invalid_argument& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr(quantity));
    }
  }
}

TEST(OpeningsInput, ALevelIsWithinTheOpening) {
  for (const double level : {-0.1, 1.6}) {
    Stream stream = Stream::open(2, {2, 1.5, 0}, 1.0, 0);
    stream.inflow().level = [level](double) { return level; };
    EXPECT_THROW(make_solver(stream.setup), std::invalid_argument) << level;
  }
}

}  // namespace
}  // namespace sluice::fluid
