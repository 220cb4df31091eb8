#include <gmock/gmock.h>

#include "protocol/formula.hpp"
#include "protocol/frame_layout.hpp"
#include "protocol/scene_check.hpp"
#include "scene_text.hpp"

namespace sluice::protocol {
namespace {

using testing::HasSubstr;

// Line 21 on, in a tank of 1 x 0.5 m with a spacing of 0.01 m.
std::string errors(const std::string& opening, const std::string& more = "") {
  return errors_of(with_line(5, "liquid { max_speed: 3 }" + more) + "opening { " + opening + " }");
}

TEST(Openings, RightOnesPass) {
  for (const char* opening :
       {"name: 'a' side: X_MIN inflow { level: '0.3 + 0.01*sin(t)' }",
        "name: 'a' side: X_MIN max: 0.3 inflow { speed: 'y*(0.3 - y)*min(1, t)' }",
        "name: 'a' side: X_MIN inflow { speed: '2' level: '0.5' }",
        "name: 'a' side: Y_MAX min: 0.2 max: 0.3 inflow { speed: '1' pressure: '0' }",
        "name: 'a' side: X_MAX outflow { }", "name: 'a' side: X_MAX outflow { level: '0.2' }",
        "name: 'a' side: X_MAX outflow { pressure: '100*x' }"})
    EXPECT_EQ(errors(opening), "") << opening;
  EXPECT_EQ(errors("name: 'a' side: X_MIN outflow { } } probe { name: 'q' flow { opening: 'a' }"), "");
}

struct Wrong {
  const char* opening;
  const char* error;
};

TEST(Openings, WrongOnesAreReportedWithTheirPlace) {
  for (const auto& [opening, error] :
       {Wrong{"side: X_MIN outflow { }", "a.scene:21:1: opening[0].name: is missing; name the opening"},
        Wrong{"name: 'a' outflow { }", "opening[0].side: 0 is not a side"},
        Wrong{"name: 'a' side: Z_MIN outflow { }", "opening[0].side: Z_MIN does not exist in two dimensions"},
        Wrong{"name: 'a' side: X_MIN", "opening[0]: has no kind; give inflow or outflow"},
        Wrong{"name: 'a' side: X_MIN min: [0, 0] outflow { }",
              "opening[0].min: has 2 entries; along a side there are 1"},
        Wrong{"name: 'a' side: X_MIN min: 0.2 max: 0.205 outflow { }",
              "opening[0].max[0]: 0.205 m is not a spacing above min, 0.2 m"},
        Wrong{"name: 'a' side: X_MIN max: 0.6 outflow { }",
              "opening[0].max[0]: 0 to 0.6 m is not within the tank, 0 to 0.5 m; shrink the opening"},
        Wrong{"name: 'a' side: X_MIN inflow { }",
              "opening[0].inflow: has neither speed nor level; give one of them, or both"},
        Wrong{"name: 'a' side: X_MIN inflow { level: '0.3' pressure: '0' }",
              "opening[0].inflow.pressure: needs a speed"},
        Wrong{"name: 'a' side: X_MIN inflow { speed: '1' level: '0.3' pressure: '0' }",
              "opening[0].inflow.level: is given with a pressure, which it sets; leave one out"},
        Wrong{"name: 'a' side: X_MIN inflow { speed: '2*q' }",
              "opening[0].inflow.speed: formula '2*q', position 3, token 'q'"},
        Wrong{"name: 'a' side: X_MIN inflow { speed: '1/t' }",
              "formula '1/t' is inf at (0, 0, 0) m, t = 0 s; it must be finite"},
        Wrong{"name: 'a' side: X_MIN min: 0.2 inflow { level: '0.1' }",
              "opening[0].inflow.level: 0.1 m at t = 0 is not above the lower edge of the opening, 0.2 m"},
        Wrong{"name: 'a' side: X_MIN max: 0.3 inflow { level: '0.3' }",
              "opening[0].inflow.level: 0.3 m at t = 0 is not below the upper edge of the opening, 0.3 m"},
        Wrong{"name: 'a' side: X_MIN outflow { } } opening { name: 'a' side: X_MAX outflow { }",
              "opening[1].name: \"a\" is the name of opening[0] too"},
        Wrong{"name: 'a' side: X_MIN max: 0.3 outflow { } } opening { name: 'b' side: X_MIN min: 0.2 outflow "
              "{ }",
              "opening[1]: overlaps opening[0]; let them touch at most"},
        Wrong{"name: 'a' side: X_MIN outflow { } } probe { name: 'q' flow { opening: 'b' }",
              "probe[0].flow.opening: there is no opening \"b\"; name one"}})
    EXPECT_THAT(errors(opening), HasSubstr(error)) << opening;
}

TEST(Openings, WhatTheyDoNotGoWithIsReported) {
  const std::string outflow = "name: 'a' side: X_MIN outflow { }";
  EXPECT_THAT(errors(outflow, " formulation { integrator: LEAP_FROG }"),
              HasSubstr("formulation.integrator: openings are built for KICK_DRIFT_KICK only"));
  EXPECT_THAT(errors(outflow, " formulation { quadrature: STRESS_POINTS }"),
              HasSubstr("formulation.quadrature: openings are built for NODAL only"));
  EXPECT_THAT(errors("name: 'a' side: X_MIN inflow { level: '0.3' }", " gravity: [0, 0]"),
              HasSubstr("opening[0].inflow.level: needs gravity; give a pressure instead"));
  EXPECT_THAT(errors_of(kScene + "opening { name: 'a' side: X_MIN inflow { speed: '1' } }"),
              HasSubstr("opening[0].inflow.speed: needs liquid.max_speed"));
}

TEST(Openings, TheSpeedExpectedFollowsFromTheLevel) {
  Scene scene;
  scene.set_dimension(2);
  scene.mutable_domain()->add_max(1);
  scene.mutable_domain()->add_max(2);
  Opening& opening = *scene.add_opening();
  opening.set_side(X_MIN);
  opening.mutable_inflow()->set_level("1.5 + t");
  const Scene full = with_defaults(scene);
  EXPECT_NEAR(full.liquid().max_speed(), std::sqrt(2 * 9.81 * 1.5), 1e-12);
  EXPECT_EQ(full.opening(0).min(0), 0);
  EXPECT_EQ(full.opening(0).max(0), 2);
  EXPECT_TRUE(particles_vary(full));
}

}  // namespace
}  // namespace sluice::protocol
