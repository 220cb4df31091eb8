#include "server/stability_watch.hpp"

#include <gmock/gmock.h>

#include "protocol/scene_check.hpp"
#include "server/simulation.hpp"
#include "server/stop.hpp"
#include "tests/coupling/scenes.hpp"

namespace sluice::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr double kDx = 0.05, kWidth = 0.6, kHeight = 0.4, kDensity = 100, kSound = 40;
constexpr double kEdges = 0.13;  // particles at an edge count for one of its faces
constexpr double kMass = kDensity * kWidth * kHeight, kStep = 1e-3;

// A box in a tank, its centre at the height `y`; the water is 1 m deep.
Scene box_at(double y) {
  Scene scene = parse_scene(R"(
    name: "box" dimension: 2 spacing: 0.05 duration: 0.1
    liquid { max_speed: 4 }
    domain { max: [2, 2] }
    fluid { box { min: [0, 0] max: [2, 1] } }
    body { name: "box" box { size: [0.6, 0.4] } density: 100 position: [1, 0] displaces_fluid: true }
    output { rate: 100 }
    coupling { scheme: EXPLICIT shorten_steps: false })");
  scene.mutable_body(0)->set_position(1, y);
  return scene;
}

struct Watched {
  explicit Watched(const Scene& scene)
      : simulation(server::make_simulation(scene, 1)),
        watch(simulation.scene, simulation.coupling,
              {server::wet_surface(simulation.scene, 0, simulation.boundaries[0])}, kStep) {}
  void look() { watch.look(simulation.solver->snapshot().position, simulation.bodies, 0.25); }
  double indicator() {
    look();
    return watch.indicators()[0];
  }

  server::Simulation simulation;
  server::StabilityWatch watch;
};

// rho0 c0 t/m times the length of what is wet across the motion.
double expected(double length) {
  return 1000 * kSound * kStep / kMass * length;
}

// Under water both long sides answer; afloat the lower one; in the air none.
TEST(StabilityWatch, CountsWhatIsWet) {
  const double layer = 3 * kDx / kWidth * expected(kWidth);
  EXPECT_NEAR(Watched(box_at(0.5)).indicator(), expected(2 * kWidth), kEdges * expected(2 * kWidth));
  EXPECT_NEAR(Watched(box_at(1.0)).indicator(), expected(kWidth), layer);
  EXPECT_EQ(Watched(box_at(1.7)).indicator(), 0);
}

TEST(StabilityWatch, CountsOnlyAxesThatAreFree) {
  Scene scene = box_at(0.5);
  scene.mutable_body(0)->add_locked(Y_AXIS);
  scene.mutable_body(0)->add_locked_rotation(Z_AXIS);
  EXPECT_NEAR(Watched(scene).indicator(), expected(2 * kHeight), kEdges * expected(2 * kHeight));
}

// A body that is turned and moved by its kinematics is looked at where it is.
TEST(StabilityWatch, LooksWhereTheBodyIs) {
  Watched watched(box_at(0.5));
  const auto indicator = [&](double y, double angle) {
    watched.simulation.bodies[0].position.y() = y;
    watched.simulation.bodies[0].orientation = Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ());
    return watched.indicator();
  };
  EXPECT_EQ(indicator(1.7, 0), 0);
  EXPECT_NEAR(indicator(1.2 + kDx, M_PI / 2), expected(kHeight), 0.3 * expected(kHeight));
}

// The plan counts all the surface as wet: more than any look finds.
TEST(StabilityWatch, NeverFindsMoreThanThePlan) {
  for (const double y : {0.5, 0.8, 1.0, 1.1}) {
    Watched watched(box_at(y));
    const double step = protocol::seconds(watched.simulation.clock.duration(1));
    EXPECT_LE(watched.indicator(),
              watched.simulation.coupling.stability[0].indicator() * kStep / step * (1 + 1e-6))
        << y;
  }
}

TEST(StabilityWatch, RefusesTheBodyWithTimeValueAndWhatToSet) {
  Scene scene = box_at(0.5);
  Watched warned(scene);
  EXPECT_NO_THROW(warned.look());
  scene.mutable_coupling()->set_when_unstable(REFUSE);
  Watched refused(scene);
  EXPECT_THAT([&] { refused.look(); },
              ::testing::ThrowsMessage<server::Stop>(AllOf(HasSubstr("body 'box' at t = 0.25 s"),
                                                           HasSubstr("is 1.83"), HasSubstr("scheme: AUTO"))));
  scene.mutable_coupling()->clear_shorten_steps();
  scene.mutable_coupling()->set_scheme(IMPLICIT);
  Watched iterated(scene);
  EXPECT_NO_THROW(iterated.look());
  Accepted accepted;
  accepted.set_iterations(20);
  accepted.set_residual(1e-4);
  EXPECT_NO_THROW(iterated.watch.note(accepted, 0.25));
  accepted.set_residual(0.1);
  EXPECT_THAT([&] { iterated.watch.note(accepted, 0.25); },
              ::testing::ThrowsMessage<server::Stop>(HasSubstr("given up after 20 iterations")));
}

}  // namespace
}  // namespace sluice::testing
