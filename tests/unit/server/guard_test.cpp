#include "server/guard.hpp"

#include <gmock/gmock.h>

#include <limits>

#include "scene_text.hpp"
#include "server/stop.hpp"

namespace sluice::testing {
namespace {

using ::testing::HasSubstr;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// Three calm particles in a tank 1 m by 2 m; density 1000 kg/m^3, speed of sound 40 m/s.
class GuardTest : public ::testing::Test {
 protected:
  // What the guard says of the state, empty when nothing.
  std::string verdict() const {
    try {
      guard_.check(state_, 0.25);
    } catch (const server::Stop& stop) {
      EXPECT_EQ(stop.reason(), End::UNSTABLE);
      return stop.what();
    }
    return {};
  }

  Scene scene_ = tank_with("");
  server::Guard guard_{scene_};
  fluid::Snapshot state_{std::vector<double>(9, 0.5),
                         std::vector<double>(9, 0.0),
                         std::vector<double>(3, 1000.0),
                         std::vector<double>(3, 0.0),
                         {0, 1, 2},
                         {}};
};

TEST_F(GuardTest, LetsACalmStatePass) {
  EXPECT_EQ(verdict(), "");
}

TEST_F(GuardTest, NamesParticlePlaceAndTime) {
  state_.density[2] = 1501;
  state_.position[6] = 0.125;
  EXPECT_THAT(verdict(), HasSubstr("particle 2 at (0.125, 0.5, 0.5) m, t = 0.25 s"));
}

TEST_F(GuardTest, BoundsTheDensity) {
  state_.density[1] = 1500;
  EXPECT_EQ(verdict(), "");
  state_.density[1] = 499;
  EXPECT_THAT(verdict(), HasSubstr("density 499"));
}

TEST_F(GuardTest, BoundsTheSpeed) {
  state_.velocity[3] = 39;
  EXPECT_EQ(verdict(), "");
  state_.velocity[4] = 39;
  EXPECT_THAT(verdict(), HasSubstr("above the speed of sound 40 m/s"));
}

TEST_F(GuardTest, BoundsThePlace) {
  state_.position[3] = 1.9;  // outside, but not by more than the tank's width
  EXPECT_EQ(verdict(), "");
  state_.position[3] = 2.1;
  EXPECT_THAT(verdict(), HasSubstr("outside the tank"));
  state_.position[3] = 0.5;
  state_.position[4] = -2.1;
  EXPECT_THAT(verdict(), HasSubstr("outside the tank"));
}

TEST_F(GuardTest, FindsWhatIsNotFinite) {
  for (double* value : {&state_.position[4], &state_.velocity[4], &state_.density[1], &state_.pressure[1]}) {
    const double before = *value;
    *value = kNan;
    EXPECT_THAT(verdict(), HasSubstr("not finite"));
    *value = std::numeric_limits<double>::infinity();
    EXPECT_THAT(verdict(), HasSubstr("not finite"));
    *value = before;
  }
}

TEST_F(GuardTest, FindsForcesThatAreNotFinite) {
  scene_.add_body()->set_name("buoy");
  fluid::Wrench wrench;
  guard_.check(std::vector<fluid::Wrench>{wrench}, 0.25);
  wrench.moment.z() = kNan;
  EXPECT_THROW(guard_.check(std::vector<fluid::Wrench>{wrench}, 0.25), server::Stop);
}

}  // namespace
}  // namespace sluice::testing
