#include "clients/rigid/window.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace sluice::clients {
namespace {

constexpr double kDt = 1e-3;

rigid::WorldSpec disc(double mass) {
  rigid::BodySpec body;
  body.name = "disc";
  body.shape = rigid::Ball{0.1};
  body.mass = mass;
  rigid::WorldSpec spec;
  spec.dimension = 2;
  spec.bodies = {body};
  return spec;
}

Coupling coupling(CouplingScheme scheme, double tolerance = 1e-10) {
  Coupling c;
  c.set_scheme(scheme);
  c.set_tolerance(tolerance);
  c.set_most_iterations(50);
  return c;
}

// A liquid that resists like a dashpot with a spring in series: what sound does at a surface that moves. The
// force follows F' = (Z v_F - F)/tau with v_F the velocity of the body over the step, to the left.
class Liquid {
 public:
  Liquid(double impedance, double drive) : impedance_(impedance), drive_(drive) {}
  // The force at the end of a step over which the body had that velocity.
  rigid::Wrench step(const rigid::Kinematics& body, double dt) {
    const double tau = 2 * kDt;
    force_ += dt / tau * (-impedance_ * body.velocity.x() - force_);
    time_ += dt;
    rigid::Wrench wrench;
    wrench.force.x() = force_ + drive_ * std::sin(40 * time_);
    return wrench;
  }

 private:
  double impedance_, drive_, force_ = 0, time_ = 0;
};

struct Course {
  double impulse = 0;   // by the liquid, as its steps felt it
  double momentum = 0;  // of the body at the end
  double fastest = 0;   // of the body
  int most_iterations = 0;
};

Course run(const Coupling& settings, double mass, double impedance, std::size_t count, int exchanges) {
  rigid::World world(disc(mass));
  Window window(world, settings, Eigen::Vector3d::Zero(), std::vector<double>{impedance * kDt / mass},
                {rigid::Wrench{}});
  Liquid liquid(impedance, 1.0);
  Course course;
  double last = 0, time = 0;
  for (int n = 0; n < exchanges; ++n) {
    std::vector<Window::Step> steps;
    for (std::size_t k = 0; k < count; ++k) steps.push_back({time += kDt, kDt});
    window.begin(steps);
    const Liquid saved = liquid;
    std::vector<Window::Wrenches> answer;
    do {
      liquid = saved;
      answer.clear();
      for (const Window::Motion& motion : window.predict()) {
        answer.push_back({liquid.step(motion[0], kDt)});
        course.fastest = std::max(course.fastest, std::abs(motion[0].velocity.x()));
      }
    } while (!window.accept(answer));
    course.most_iterations = std::max(course.most_iterations, window.iterations());
    for (const Window::Wrenches& at_end : answer) {
      course.impulse += kDt / 2 * (last + at_end[0].force.x());
      last = at_end[0].force.x();
    }
  }
  course.momentum = mass * world.state(0).velocity.x();
  return course;
}

// Whatever the scheme and however badly it converges, the body gets what the liquid gave.
TEST(Window, MomentumClosesInEveryScheme) {
  for (const CouplingScheme scheme : {EXPLICIT, IMPLICIT})
    for (const std::size_t count : {1u, 4u, 16u})
      for (const double tolerance : {1e-10, 0.5}) {
        const Course course = run(coupling(scheme, tolerance), 1, 100, count, 50);
        EXPECT_NEAR(course.momentum, course.impulse, 1e-13 * (1 + std::abs(course.impulse)))
            << scheme << " " << count << " " << tolerance;
      }
}

TEST(Window, ImplicitIsStableWhereExplicitIsNot) {
  for (const std::size_t count : {1u}) {
    double grown = 0;
    try {
      grown = run(coupling(EXPLICIT), 1e-2, 400, count, 40).fastest;
    } catch (const std::exception&) {  // the world refuses what is no longer finite
      grown = INFINITY;
    }
    EXPECT_GT(grown, 1e2) << count;
    const Course stable = run(coupling(IMPLICIT, 1e-4), 1e-2, 400, count, 400);
    EXPECT_LT(stable.fastest, 0.1) << count;
    EXPECT_LT(stable.most_iterations, 50) << count;
  }
}

// Two iterations find the answer of a linear liquid for a step and one component; the third confirms it.
TEST(Window, AitkenFindsALinearAnswerAtOnce) {
  EXPECT_LE(run(coupling(IMPLICIT, 1e-9), 1e-2, 400, 1, 100).most_iterations, 4);
}

// Without liquid to answer there is nothing to divide by.
TEST(Window, NothingToAgreeOnTakesOneIteration) {
  rigid::World world(disc(1));
  Window window(world, coupling(IMPLICIT), Eigen::Vector3d::Zero(), std::vector<double>{0.0},
                {rigid::Wrench{}});
  window.begin({{kDt, kDt}});
  window.predict();
  EXPECT_TRUE(window.accept({{rigid::Wrench{}}}));
  EXPECT_EQ(window.iterations(), 1);
  EXPECT_EQ(window.residual(), 0);
}

// An exchange of one explicit step is kick - drift - kick.
TEST(Window, OneExplicitStepIsThatOfTheWorld) {
  rigid::World world(disc(2)), plain(disc(2));
  Window window(world, coupling(EXPLICIT), Eigen::Vector3d::Zero(), {}, {rigid::Wrench{}});
  plain.start(std::vector<rigid::Wrench>(1));
  for (int n = 1; n <= 20; ++n) {
    rigid::Wrench wrench;
    wrench.force = {std::sin(0.3 * n), 0.1 * n, 0};
    wrench.moment = {0, 0, std::cos(n)};
    window.begin({{n * kDt, kDt}});
    const auto motion = window.predict();
    const auto expected = plain.predict(n * kDt, kDt);
    EXPECT_EQ(motion[0][0].position, expected[0].position);
    EXPECT_EQ(motion[0][0].acceleration, expected[0].acceleration);
    EXPECT_TRUE(window.accept({{wrench}}));
    plain.correct(kDt, std::vector<rigid::Wrench>{wrench});
  }
}

// The motion inside an exchange is one motion: positions, velocities and accelerations belong together.
TEST(Window, MotionInsideAnExchangeIsConsistent) {
  rigid::World world(disc(2));
  rigid::Wrench constant;
  constant.force = {3, -4, 0};
  Window window(world, coupling(EXPLICIT), Eigen::Vector3d::Zero(), {}, {constant});
  std::vector<Window::Step> steps;
  for (int k = 1; k <= 16; ++k) steps.push_back({k * kDt, kDt});
  window.begin(steps);
  const auto motion = window.predict();
  Eigen::Vector3d last = Eigen::Vector3d::Zero();
  for (std::size_t k = 0; k < motion.size(); ++k) {
    const rigid::Kinematics& body = motion[k][0];
    const double t = static_cast<double>(k + 1) * kDt;
    EXPECT_LT((body.acceleration - constant.force / 2).norm(), 1e-12);
    EXPECT_LT((body.position - t * t / 4 * constant.force).norm(), 1e-15);
    EXPECT_LT(((body.position - last) / kDt - body.velocity).norm(), 1e-12);
    last = body.position;
  }
}

TEST(Window, RollbackOfTheWorldIsExactWithContact) {
  rigid::WorldSpec spec = disc(2);
  spec.gravity = {0, -9.81, 0};
  spec.tank.max = {1, 1, 0};
  spec.tank.closed = {true, true, true, false, false, false};
  spec.bodies[0].shape = rigid::Box{{0.1, 0.1, 0}};
  spec.bodies[0].pose.position = {0.5, 0.1, 0};
  rigid::World world(spec);
  std::vector<rigid::Wrench> push(1);
  push[0].force = {2, 0, 0};
  double time = 0;
  for (int n = 0; n < 100; ++n) {
    time += kDt;
    world.save();
    const rigid::Kinematics first = world.predict(time, kDt)[0];
    world.correct(kDt, push);
    world.restore();
    const rigid::Kinematics second = world.predict(time, kDt)[0];
    ASSERT_EQ(first.position, second.position);
    ASSERT_EQ(first.velocity, second.velocity);
    ASSERT_EQ(first.acceleration, second.acceleration);
    world.correct(kDt, push);
  }
}

}  // namespace
}  // namespace sluice::clients
