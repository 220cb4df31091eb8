#include "clients/preflight/preflight.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>

namespace sluice::protocol {
void PrintTo(const Problem& problem, std::ostream* out) {
  *out << to_string(problem);
}
}  // namespace sluice::protocol

namespace sluice::clients {
namespace {

using protocol::Problem;
using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::Field;
using testing::HasSubstr;
using testing::IsEmpty;

class PreflightTest : public testing::Test {
 protected:
  PreflightTest() {
    std::string name = (std::filesystem::temp_directory_path() / "preflight-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("mkdtemp");
    directory_ = name;
  }
  ~PreflightTest() override { std::filesystem::remove_all(directory_); }

  // A tank of 1 m x 1 m, open above, with 0.4 m x 0.5 m of water at its left; `more` is added to it.
  Preflight check(const std::string& more, const std::string& fluid = "box { min: [0, 0] max: [0.4, 0.5] }") {
    std::ofstream(directory_ / "test.scene") << "name: \"test\"\n"
                                                "dimension: 2\n"
                                                "spacing: 0.01\n"
                                                "duration: 1\n"
                                                "domain { max: [1, 1] open: Y_MAX }\n"
                                             << (fluid.empty() ? "" : "fluid { " + fluid + " }") << "\n"
                                             << more;
    return preflight(protocol::SceneFile::load(directory_ / "test.scene"));
  }

  std::filesystem::path directory_;
};

auto problem(const std::string& field, const std::string& text) {
  return AllOf(Field("field", &Problem::field, field), Field("text", &Problem::text, HasSubstr(text)));
}

std::string block(const std::string& rest) {
  return "body { name: \"block\" box { size: [0.2, 0.2] } density: 500 " + rest + " }";
}
std::string moving(const std::string& motion) {
  return "body {\n"
         "  name: \"gate\"\n"
         "  box { size: [0.2, 0.2] }\n"
         "  position: [0.7, 0.5]\n"
         "  prescribed { " +
         motion +
         " }\n"
         "}\n";
}

TEST_F(PreflightTest, good_scene_has_no_findings) {
  const Preflight result = check(block("position: [0.7, 0.5]"));
  EXPECT_THAT(result.errors, IsEmpty());
  EXPECT_THAT(result.warnings, IsEmpty());
}

TEST_F(PreflightTest, touching_liquid_walls_and_bodies_is_fine) {
  EXPECT_THAT(check(block("position: [0.5, 0.1]") + "body { name: \"other\" ball { radius: 0.1 } density: 1 "
                                                    "position: [0.7, 0.1] }")
                  .errors,
              IsEmpty());
}

TEST_F(PreflightTest, body_in_the_liquid) {
  const Preflight result = check(block("position: [0.48, 0.3]"));
  EXPECT_THAT(result.errors,
              ElementsAre(problem("body[0].position", "body 'block' stands 0.02 m deep in the liquid")));
  EXPECT_EQ(result.errors[0].where.line, 7);
  EXPECT_THAT(check(block("position: [0.48, 0.3] displaces_fluid: true")).errors, IsEmpty());
}

TEST_F(PreflightTest, liquid_in_a_hollow_polygon_is_seen_where_it_is) {
  const std::string trough =  // a U: arms left and right, an empty middle
      "polygon { vertex { x: 0 y: 0 } vertex { x: 0.9 y: 0 } vertex { x: 0.9 y: 0.6 } vertex { x: 0.7 y: 0.6 "
      "} "
      "vertex { x: 0.7 y: 0.2 } vertex { x: 0.2 y: 0.2 } vertex { x: 0.2 y: 0.6 } vertex { x: 0 y: 0.6 } }";
  EXPECT_THAT(check(block("position: [0.45, 0.45]"), trough).errors, IsEmpty());
  EXPECT_THAT(check(block("position: [0.45, 0.29]"), trough).errors,
              ElementsAre(problem("body[0].position", "0.01 m deep")));
  const Preflight result = check("", trough);
  EXPECT_EQ(result.estimate.fluid_particles, 3400u);
}

TEST_F(PreflightTest, bodies_that_overlap) {
  EXPECT_THAT(check(block("position: [0.6, 0.5]") + "body { name: \"ball\" ball { radius: 0.1 } density: 1 "
                                                    "position: [0.77, 0.5] }")
                  .errors,
              ElementsAre(problem("body[1].position", "body 'ball' overlaps body 'block' by 0.03 m")));
}

TEST_F(PreflightTest, body_in_a_wall_but_not_in_an_open_side) {
  EXPECT_THAT(check(block("position: [0.95, 0.5]")).errors,
              ElementsAre(problem("body[0].position", "reaches 0.05 m through the wall at x_max")));
  EXPECT_THAT(check(block("position: [0.7, 1]")).errors, IsEmpty());
}

TEST_F(PreflightTest, motion_through_a_wall_names_body_and_first_time) {
  // 0.5 t^2 to the right: 0.2 m of room (and a thousandth of the spacing) are used up at sqrt(0.4).
  const Preflight result = check(moving("expression { x: \"0.5*t^2\" }"));
  ASSERT_THAT(result.errors, ElementsAre(problem("body[0].prescribed",
                                                 "body 'gate' leaves the domain through the wall "
                                                 "at x_max at t = 0.6324")));
  EXPECT_EQ(result.errors[0].where.line, 11);
}

TEST_F(PreflightTest, motion_out_and_back_between_samples_of_a_coarse_grid_is_found) {
  const std::string spike =
      "keyframes { key { time: 0.5 } key { time: 0.5002 offset: [0, -0.5] } key { time: 0.5004 } }";
  EXPECT_THAT(check(moving(spike)).errors, Contains(problem("body[0].prescribed", "y_min at t = 0.5001")));
}

TEST_F(PreflightTest, motion_may_leave_through_an_open_side) {
  EXPECT_THAT(check(moving("constant { velocity: [0, 0.9] }")).errors, IsEmpty());
}

TEST_F(PreflightTest, rotation_is_seen) {
  const std::string bar =
      "body { name: \"bar\" box { size: [0.7, 0.1] } position: [0.7, 0.5] "
      "angle: 1.5707963267948966 prescribed { constant { angular_velocity: [1] } } }";
  EXPECT_THAT(check(bar, "box { min: [0, 0] max: [0.3, 0.5] }").errors,
              ElementsAre(problem("body[0].prescribed", "x_max at t = ")));
}

TEST_F(PreflightTest, motion_that_does_not_start_at_zero) {
  EXPECT_THAT(check(moving("expression { y: \"0.1*cos(t)\" }")).errors,
              ElementsAre(problem("body[0].prescribed", "starts at offset (0, 0.1, 0) m")));
}

TEST_F(PreflightTest, formula_that_does_not_parse_is_located) {
  const Preflight result = check(
      "body {\n"
      "  name: \"gate\"\n"
      "  box { size: [0.2, 0.2] }\n"
      "  position: [0.7, 0.5]\n"
      "  prescribed {\n"
      "    expression {\n"
      "      x: \"t\"\n"
      "      y: \"0.1*sn(t)\"\n"
      "    }\n"
      "  }\n"
      "}\n");
  ASSERT_THAT(result.errors, ElementsAre(problem("body[0].prescribed.expression.y", "token 'sn'")));
  EXPECT_EQ(result.errors[0].where.line, 14);
}

TEST_F(PreflightTest, formula_that_is_not_finite_during_the_run) {
  EXPECT_THAT(check(moving("expression { y: \"0.001*t/(t-0.5)\" }")).errors,
              ElementsAre(problem("body[0].prescribed.expression.y", "must be finite")));
}

TEST_F(PreflightTest, motion_fast_against_sound) {
  const Preflight result = check(moving("constant { velocity: [0, 5] }"));
  EXPECT_THAT(result.errors, IsEmpty());
  EXPECT_THAT(result.warnings, ElementsAre(problem("body[0].prescribed", "moves at up to 5 m/s")));
}

// Shapes that the thin-plate rule does not know, by what is thin of them; two supports are 0.058 m.
TEST_F(PreflightTest, thin_bodies_without_the_plate_rule) {
  const auto shape = [](const std::string& text) {
    return "body { name: \"hull\" " + text + " density: 500 position: [0.7, 0.4] }";
  };
  const auto angle = [&](double t) {
    return shape(fmt::format(
        "polygon {{ vertex {{}} vertex {{ x: 0.3 }} vertex {{ x: 0.3 y: {0} }} vertex {{ x: {0} y: "
        "{0} }} vertex {{ x: {0} y: 0.2 }} vertex {{ y: 0.2 }} }}",
        t));
  };
  EXPECT_THAT(check(angle(0.06)).warnings, IsEmpty());
  EXPECT_THAT(
      check(angle(0.04)).warnings,
      ElementsAre(problem("body[0]", "body 'hull' is 0.04 m thick at its thinnest, less than two supports")));
  EXPECT_THAT(check(angle(0.02)).warnings, ElementsAre(problem("body[0]", "interacts through it")));
  EXPECT_THAT(check(angle(0.02)).warnings, ElementsAre(problem("body[0]", "take a spacing below 0.00345 m")));
  EXPECT_THAT(check(angle(0.009)).errors,
              ElementsAre(problem("body[0]", "thinner than one particle spacing")));
  const std::string ball = "part { ball { radius: 0.015 } position: [0.2, 0] }";
  EXPECT_THAT(check(shape("compound { part { box { size: [0.2, 0.1] } } " + ball + " }")).warnings,
              ElementsAre(problem("body[0]", "0.03 m thick at its thinnest")));
  EXPECT_THAT(check(shape("ball { radius: 0.02 }")).warnings,
              ElementsAre(problem("body[0]", "0.04 m thick")));
}

// The support is 0.029 m.
TEST_F(PreflightTest, thin_bodies_of_boundary_forces) {
  const auto plate = [](const std::string& width) {
    return "formulation { boundary: FORCES } body { name: \"plate\" box { size: [" + width +
           ", 0.3] } density: 500 position: [0.7, 0.5] }";
  };
  EXPECT_THAT(check(plate("0.03")).errors, IsEmpty());
  EXPECT_THAT(check(plate("0.03")).warnings, IsEmpty());
  EXPECT_THAT(check(plate("0.028")).errors, ElementsAre(problem("body[0]", "does not keep its sides apart")));
}

TEST_F(PreflightTest, thin_bodies) {
  const auto plate = [](const std::string& width) {
    return "body { name: \"plate\" box { size: [" + width + ", 0.3] } density: 500 position: [0.7, 0.5] }";
  };
  EXPECT_THAT(check(plate("0.0581")).warnings, IsEmpty());
  EXPECT_THAT(check(plate("0.0579")).warnings, ElementsAre(problem("body[0]", "thin-plate rule")));
  const std::string part = "part { box { size: [0.2, 0.03] } position: [";
  EXPECT_THAT(check("body { name: \"two\" compound { " + part + "0, 0] } " + part +
                    "0.2, 0] } } density: 500 position: [0.5, 0.5] }")
                  .warnings,
              ElementsAre(problem("body[0]", "thin-plate rule")));
  EXPECT_THAT(check(plate("0.01")).errors, IsEmpty());
  EXPECT_THAT(check(plate("0.009")).errors,
              ElementsAre(problem("body[0]", "thinner than one particle spacing")));
  EXPECT_THAT(
      check("body { name: \"bead\" ball { radius: 0.014 } density: 500 position: [0.7, 0.5] }").warnings,
      ElementsAre(problem("body[0]", "interacts through it")));
}

TEST_F(PreflightTest, liquid_missing_outside_twice_or_shallow) {
  EXPECT_THAT(check("", "box { min: [0, 0] max: [1.1, 0.5] }").errors,
              ElementsAre(problem("fluid[0]", "0.1 m beyond x_max")));
  EXPECT_THAT(check("", "box { min: [0, 0.8] max: [0.4, 1.2] }").errors,
              ElementsAre(problem("fluid[0]", "0.2 m beyond y_max")));
  EXPECT_THAT(check("fluid { ball { center: [0.45, 0.3] radius: 0.1 } }").errors,
              ElementsAre(problem("fluid[1]", "overlaps fluid[0] by 0.05 m")));
  EXPECT_THAT(check("", "box { min: [0, 0] max: [0.4, 0.09] }").warnings,
              ElementsAre(problem("fluid[0]", "9.0 particles")));
  EXPECT_THAT(check("", "box { min: [0, 0] max: [0.4, 0.1] }").warnings, IsEmpty());
}

TEST_F(PreflightTest, estimates) {
  const Estimate cost = check("output { rate: 100 }").estimate;
  EXPECT_EQ(cost.fluid_particles, 2000u);
  EXPECT_EQ(cost.boundary_particles,
            3u * (2 * 100 + 100) + 2 * 9);  // three layers on three sides, two corners
  // dt = 0.4 * 0.0145 / (11 sqrt(2 g 0.5)), rounded down to a whole number of steps in 0.01 s
  EXPECT_EQ(cost.steps, 6000u);
  EXPECT_GT(cost.memory_bytes, 2000u * 100);
  EXPECT_GT(cost.run_seconds, 0);

  const Estimate cut = check(block("position: [0.2, 0.3] displaces_fluid: true")).estimate;
  EXPECT_EQ(cut.fluid_particles, 1600u);
}

TEST_F(PreflightTest, parts_of_a_compound_may_touch_but_not_overlap) {
  const auto pair = [](const std::string& x) {
    return "body { name: \"pair\" density: 500 position: [0.7, 0.5] compound { part { box { size: [0.1, 0.1] "
           "} }"
           "part { ball { radius: 0.05 } position: [" +
           x + ", 0] } } }";
  };
  EXPECT_THAT(check(pair("0.1")).errors, IsEmpty());
  EXPECT_THAT(check(pair("0.09")).errors,
              ElementsAre(problem("body[0].compound", "parts of body 'pair' overlap by 0.01 m")));
}

TEST_F(PreflightTest, body_that_is_not_convex_may_embrace_another) {
  const std::string trough =
      "body { name: \"trough\" density: 500 position: [0.7, 0.7] center_of_mass: [0.15, 0.1] polygon { "
      "vertex { } vertex { x: 0.3 } vertex { x: 0.3 y: 0.2 } vertex { x: 0.25 y: 0.2 } vertex { x: 0.25 y: "
      "0.05 } "
      "vertex { x: 0.05 y: 0.05 } vertex { x: 0.05 y: 0.2 } vertex { y: 0.2 } } }\n";
  const auto ball = [](const std::string& y) {
    return "body { name: \"ball\" density: 500 ball { radius: 0.05 } position: [0.7, " + y + "] }";
  };
  EXPECT_THAT(check(trough + ball("0.72")).errors, IsEmpty());
  EXPECT_THAT(check(trough + ball("0.69")).errors, ElementsAre(problem("body[1].position", "by 0.01 m")));
}

TEST_F(PreflightTest, motion_of_a_released_body_is_followed_until_then) {
  const std::string gate =
      "body { name: \"gate\" box { size: [0.1, 0.1] } position: [0.7, 0.5] density: 500 "
      "prescribed { constant { velocity: [0, -1] } ";
  EXPECT_THAT(check(gate + "release: 0.3 } }").errors, IsEmpty());
  EXPECT_THAT(check(gate + "} }").errors, ElementsAre(problem("body[0].prescribed", "leaves the domain")));
}

}  // namespace
}  // namespace sluice::clients
