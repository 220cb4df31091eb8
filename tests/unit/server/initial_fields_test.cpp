#include "server/initial_fields.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "scene_text.hpp"
#include "server/liquid.hpp"

namespace sluice::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr const char* kBox = "box { min: [0, 0] max: [0.5, 0.5] } ";

fluid::FluidParticles fill(const std::string& fields) {
  return server::fill_liquid(tank_with("fluid { " + (kBox + fields) + " }"));
}

protocol::Problem problem(const std::string& fields) {
  try {
    fill(fields);
  } catch (const protocol::SceneError& error) {
    return error.problems().at(0);
  }
  throw std::runtime_error("the scene was accepted");
}

TEST(InitialFields, GiveEveryParticleItsVelocityAndPressure) {
  const fluid::FluidParticles liquid =
      fill("velocity_field { x: '2*y' y: '-x^2' } pressure: '100*sin(pi*x)*y'");
  ASSERT_EQ(liquid.position.size(), 25u);
  for (std::size_t i = 0; i < liquid.position.size(); ++i) {
    const double x = liquid.position[i].x(), y = liquid.position[i].y();
    EXPECT_LT((liquid.velocity[i] - Eigen::Vector3d(2 * y, -x * x, 0)).norm(), 1e-14);
    EXPECT_NEAR(liquid.pressure[i], 100 * std::sin(M_PI * x) * y, 1e-12);
  }
}

// Fields that name the lattice point show which point they were taken at.
TEST(InitialFields, AreTakenWhereTheParticleWasBeforeItsDisplacement) {
  const fluid::FluidParticles flat = fill("");
  const fluid::FluidParticles moved =
      fill("displacement { x: '0.1 + 0.2*y' } velocity_field { x: 'x' y: 'y' } pressure: '1000*x + y'");
  const fluid::FluidParticles heavy = fill("displacement { y: '0.3*x' }");
  ASSERT_EQ(moved.position.size(), flat.position.size());
  for (std::size_t i = 0; i < flat.position.size(); ++i) {
    const Eigen::Vector3d& x = flat.position[i];
    EXPECT_LT((moved.position[i] - x - Eigen::Vector3d(0.1 + 0.2 * x.y(), 0, 0)).norm(), 1e-14);
    EXPECT_LT((moved.velocity[i] - x).norm(), 1e-14);
    EXPECT_NEAR(moved.pressure[i], 1000 * x.x() + x.y(), 1e-12);
    EXPECT_EQ(heavy.pressure[i], flat.pressure[i]);
    EXPECT_GT(flat.pressure[i], 0);
  }
}

TEST(InitialFields, MayMoveParticlesIntoTheTankButNotOutOfIt) {
  const protocol::Problem p = problem("displacement { x: '-0.1' }");
  EXPECT_EQ(p.field, "fluid[0]");
  EXPECT_THAT(p.text, HasSubstr("outside the tank"));
  const Scene scene = tank_with("fluid { box { min: [1, 0] max: [1.5, 0.5] } displacement { x: '-0.5' } }");
  EXPECT_EQ(server::fill_liquid(scene).position.size(), 25u);
}

TEST(InitialFields, DisplaceParticlesBeforeABodyCutsThem) {
  const std::string body =
      "body { name: 'b' ball { radius: 0.2 } position: [0.7, 0.25] density: 1 displaces_fluid: true }";
  const auto count = [&](const std::string& fields) {
    return server::fill_liquid(tank_with("fluid { " + (kBox + fields) + " } " + body)).position.size();
  };
  EXPECT_EQ(count(""), 25u);
  EXPECT_LT(count("displacement { x: '0.3' }"), 25u);
}

TEST(InitialFields, RefuseValuesThatAreNotFinite) {
  const protocol::Problem p = problem("velocity_field { y: '1/(y - y)' }");
  EXPECT_EQ(p.field, "fluid[0].velocity_field.y");
  EXPECT_THAT(p.text, AllOf(HasSubstr("'1/(y - y)'"), HasSubstr("inf at ("), HasSubstr("finite")));
}

TEST(InitialFields, RefuseTensionThatTheLiquidHasNoDensityFor) {
  // rho0 c0^2 / 7 = 228,571 Pa
  EXPECT_NO_THROW(fill("pressure: '-228000'"));
  const protocol::Problem p = problem("pressure: '-229000'");
  EXPECT_EQ(p.field, "fluid[0].pressure");
  EXPECT_THAT(p.text, AllOf(HasSubstr("-229000 Pa"), HasSubstr("sound_speed")));
}

}  // namespace
}  // namespace sluice::testing
