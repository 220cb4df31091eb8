#include "server/liquid.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <google/protobuf/text_format.h>

#include <algorithm>
#include <cmath>

#include "scene_text.hpp"

namespace sluice::testing {
namespace {

using ::testing::HasSubstr;

fluid::FluidParticles fill(const std::string& text) {
  return server::fill_liquid(tank_with(text));
}

// The problem that a scene is refused for.
protocol::Problem problem(const std::string& text) {
  try {
    fill(text);
  } catch (const protocol::SceneError& error) {
    return error.problems().at(0);
  }
  throw std::runtime_error("the scene was accepted");
}

double nearest_to(const fluid::FluidParticles& liquid, const Eigen::Vector3d& point) {
  double nearest = 1e9;
  for (const Eigen::Vector3d& x : liquid.position) nearest = std::min(nearest, (x - point).norm());
  return nearest;
}

// Pressure [Pa] where the weight of the compressible liquid above is `potential` = g h [m^2/s^2]: the
// solution of dp = rho d(g h) for p = rho0 c0^2 / 7 ((rho/rho0)^7 - 1), rho0 = 1000 kg/m^3 and c0 = 40 m/s.
double pressure_below(double potential) {
  const double c0_squared = 1600, rho0 = 1000;
  return rho0 * c0_squared / 7 * (std::pow(1 + 6 * potential / c0_squared, 7.0 / 6) - 1);
}

TEST(Liquid, FillsABoxAtHalfSpacings) {
  const fluid::FluidParticles liquid =
      fill("fluid { box { min: [0.2, 0] max: [0.7, 0.3] } velocity: [1, -2] }");
  ASSERT_EQ(liquid.position.size(), 15u);
  EXPECT_LT(nearest_to(liquid, {0.25, 0.05, 0}), 1e-12);
  EXPECT_LT(nearest_to(liquid, {0.65, 0.25, 0}), 1e-12);
  EXPECT_DOUBLE_EQ(liquid.volume, 0.01);
  for (const Eigen::Vector3d& v : liquid.velocity) EXPECT_EQ(v, Eigen::Vector3d(1, -2, 0));
}

TEST(Liquid, IsHydrostaticBelowItsHighestPoint) {
  const fluid::FluidParticles liquid = fill("fluid { box { min: [0, 0] max: [1, 0.5] } }");
  for (std::size_t i = 0; i < liquid.position.size(); ++i) {
    EXPECT_NEAR(liquid.pressure[i], pressure_below(9.81 * (0.5 - liquid.position[i].y())), 1e-6);
  }
}

TEST(Liquid, IsHydrostaticAlongAnyGravity) {
  const fluid::FluidParticles liquid = fill("gravity: [3, -4] fluid { box { min: [0, 0] max: [1, 0.5] } }");
  for (std::size_t i = 0; i < liquid.position.size(); ++i) {
    // The corner (0, 0.5) is highest; depth below it is along (3, -4) / 5.
    const Eigen::Vector3d& x = liquid.position[i];
    EXPECT_NEAR(liquid.pressure[i], pressure_below(3 * x.x() - 4 * (x.y() - 0.5)), 1e-6);
  }
}

TEST(Liquid, MeasuresABallsDepthFromItsTop) {
  const fluid::FluidParticles liquid = fill("fluid { ball { center: [0.5, 1] radius: 0.3 } }");
  ASSERT_FALSE(liquid.position.empty());
  for (std::size_t i = 0; i < liquid.position.size(); ++i) {
    EXPECT_NEAR(liquid.pressure[i], pressure_below(9.81 * (1.3 - liquid.position[i].y())), 1e-6);
  }
}

TEST(Liquid, IsWithoutPressureWhenAskedOrWeightless) {
  for (const char* text : {"fluid { box { min: [0, 0] max: [1, 0.5] } hydrostatic: false }",
                           "gravity: [0, 0] fluid { box { min: [0, 0] max: [1, 0.5] } }"}) {
    const fluid::FluidParticles liquid = fill(text);
    EXPECT_TRUE(std::all_of(liquid.pressure.begin(), liquid.pressure.end(), [](double p) { return p == 0; }))
        << text;
  }
}

TEST(Liquid, TakesSeveralRegionsThatTouch) {
  EXPECT_EQ(
      fill("fluid { box { min: [0, 0] max: [0.5, 0.5] } } fluid { box { min: [0.5, 0] max: [1, 0.2] } }")
          .position.size(),
      35u);
}

TEST(Liquid, RefusesRegionsThatOverlap) {
  const protocol::Problem p =
      problem("fluid { box { min: [0, 0] max: [0.5, 0.5] } } fluid { box { min: [0.4, 0] max: [1, 0.2] } }");
  EXPECT_EQ(p.field, "fluid[1]");
  EXPECT_THAT(p.text, HasSubstr("overlaps fluid[0]"));
}

TEST(Liquid, RefusesARegionInsideALargerOneWhicheverComesFirst) {
  const std::string large = "fluid { box { min: [0, 0] max: [1, 1] } } ";
  const std::string small = "fluid { ball { center: [0.5, 0.5] radius: 0.12 } } ";
  EXPECT_THAT(problem(large + small).text, HasSubstr("overlaps"));
  EXPECT_THAT(problem(small + large).text, HasSubstr("overlaps"));
}

TEST(Liquid, RefusesToStandOutsideTheTank) {
  const protocol::Problem p = problem("fluid { box { min: [0.5, 0] max: [1.5, 0.5] } }");
  EXPECT_EQ(p.field, "fluid[0]");
  EXPECT_THAT(p.text, HasSubstr("outside the tank"));
}

TEST(Liquid, RefusesTooManyParticles) {
  const protocol::Problem p = problem("spacing: 1e-6 fluid { box { min: [0, 0] max: [1, 1] } }");
  EXPECT_EQ(p.field, "spacing");
}

TEST(Liquid, IsCutWhereABodyDisplacesIt) {
  const std::string body =
      "body { name: 'b' ball { radius: 0.2 } position: [0.5, 0.5] density: 500 displaces_fluid: true }";
  const fluid::FluidParticles liquid = fill("fluid { box { min: [0, 0] max: [1, 1] } } " + body);
  EXPECT_LT(liquid.position.size(), 100u);
  // What is outside is still there, and no longer nearer to the surface than a fifth of a spacing.
  EXPECT_GE(nearest_to(liquid, {0.5, 0.5, 0}), 0.2 + 0.02);
  std::size_t beyond = 0;
  for (int i = 0; i < 100; ++i) {
    const Eigen::Vector3d x((i % 10 + 0.5) * 0.1, (i / 10 + 0.5) * 0.1, 0);
    beyond += (x - Eigen::Vector3d(0.5, 0.5, 0)).norm() >= 0.2;
  }
  EXPECT_EQ(liquid.position.size(), beyond);
}

TEST(Liquid, IsCutAroundEveryKindOfShape) {
  const std::string shapes[] = {
      "compound { part { ball { radius: 0.15 } } part { box { size: [0.1, 0.1] } position: [0.2, 0] } }",
      "polygon { vertex {} vertex { x: 0.4 y: 0.03 } vertex { x: 0.37 y: 0.4 } vertex { x: 0.1 y: 0.1 } }"};
  for (const std::string& shape : shapes) {
    const fluid::FluidParticles liquid =
        fill("fluid { box { min: [0, 0] max: [1, 1] } } body { name: 'b' " + shape +
             " position: [0.5, 0.5] density: 500 displaces_fluid: true }");
    EXPECT_LT(liquid.position.size(), 100u) << shape;
    EXPECT_GE(nearest_to(liquid, {0.5, 0.5, 0}), 0.05) << shape;
  }
  const std::string solids[] = {"cylinder { radius: 0.22 length: 0.37 }",
                                "mesh { vertex: [0.3, 0, 0, 0, 0.3, 0, -0.2, -0.2, 0, 0, 0, 0.3] "
                                "triangle: [0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3] }",
                                "compound { part { ball { radius: 0.15 } } part { cylinder { radius: 0.1 "
                                "length: 0.2 } position: [0.3, 0, 0] } }"};
  for (const std::string& shape : solids) {
    Scene scene;
    ASSERT_TRUE(google::protobuf::TextFormat::ParseFromString(
        "name: 'tank' dimension: 3 spacing: 0.1 duration: 1 domain { max: [1, 1, 1] } "
        "fluid { box { min: [0, 0, 0] max: [1, 1, 1] } } body { name: 'b' " +
            shape + " position: [0.5, 0.5, 0.5] density: 500 displaces_fluid: true }",
        &scene));
    const fluid::FluidParticles liquid = server::fill_liquid(protocol::with_defaults(scene));
    EXPECT_LT(liquid.position.size(), 1000u) << shape;
    EXPECT_GE(nearest_to(liquid, {0.5, 0.5, 0.5}), 0.03) << shape;
  }
}

TEST(Liquid, IsCutAroundABodyInItsPose) {
  // A bar on its side: turned by a quarter, it stands upright.
  const std::string body =
      "body { name: 'bar' box { size: [0.8, 0.2] } position: [0.5, 0.5] angle: 1.5707963267948966 "
      "density: 500 displaces_fluid: true }";
  const fluid::FluidParticles liquid = fill("fluid { box { min: [0, 0] max: [1, 1] } } " + body);
  EXPECT_GT(nearest_to(liquid, {0.5, 0.85, 0}), 0.1);
  EXPECT_LT(nearest_to(liquid, {0.85, 0.55, 0}), 1e-9);
}

// With a second body beside it nothing is packed; still nothing stands nearer to a surface than a quarter of
// a spacing, and nothing is lost.
TEST(Liquid, KeepsOffTheBodiesThatItIsNotPackedAround) {
  const auto ball = [](const char* name, double x) {
    return fmt::format(
        "body {{ name: '{}' ball {{ radius: 0.103 }} position: [{}, 0.503] density: 500 "
        "displaces_fluid: true }} ",
        name, x);
  };
  const fluid::FluidParticles liquid =
      fill("fluid { box { min: [0, 0] max: [1, 1] } } " + ball("a", 0.3) + ball("b", 0.6));
  std::size_t outside = 0;
  for (int i = 0; i < 100; ++i) {
    const Eigen::Vector3d x((i % 10 + 0.5) * 0.1, (i / 10 + 0.5) * 0.1, 0);
    outside += (x - Eigen::Vector3d(0.3, 0.503, 0)).norm() >= 0.103 &&
               (x - Eigen::Vector3d(0.6, 0.503, 0)).norm() >= 0.103;
  }
  EXPECT_EQ(liquid.position.size(), outside);
  EXPECT_GE(nearest_to(liquid, {0.3, 0.503, 0}), 0.103 + 0.0249);
  EXPECT_GE(nearest_to(liquid, {0.6, 0.503, 0}), 0.103 + 0.0249);
}

TEST(Liquid, ABodyAtItsEdgeDisplacesNothing) {
  const std::string gate = "body { name: 'gate' box { size: [0.1, 1] } position: [0.55, 0.5] density: 1 ";
  const std::string water = "fluid { box { min: [0, 0] max: [0.5, 0.5] } } ";
  EXPECT_EQ(fill(water + gate + "}").position.size(), 25u);
  EXPECT_EQ(fill(water + gate + "displaces_fluid: true }").position.size(), 25u);
}

TEST(Liquid, RefusesABodyThatStandsInItUnasked) {
  const protocol::Problem p = problem(
      "fluid { box { min: [0, 0] max: [1, 1] } } body { name: 'buoy' ball { radius: 0.2 } position: [0.5, "
      "0.5] "
      "density: 500 }");
  EXPECT_EQ(p.field, "body[0]");
  EXPECT_THAT(p.text, HasSubstr("\"buoy\" stands in liquid"));
  EXPECT_THAT(p.text, HasSubstr("displaces_fluid: true"));
}

TEST(Liquid, RefusesASceneOfWhichNoneIsLeft) {
  EXPECT_EQ(problem("fluid { box { min: [0.4, 0.4] max: [0.6, 0.6] } } body { name: 'b' ball { radius: 0.3 } "
                    "position: [0.5, 0.5] density: 500 displaces_fluid: true }")
                .field,
            "fluid");
}

}  // namespace
}  // namespace sluice::testing
