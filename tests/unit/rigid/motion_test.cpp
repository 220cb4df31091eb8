#include "rigid/motion.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "rigid/shape.hpp"

namespace sluice::rigid {
namespace {

using testing::HasSubstr;
constexpr double kPi = std::numbers::pi;

Key key(double time, double x, double angle = 0) {
  return {time, {x, 0, 0}, angle};
}

TEST(ConstantVelocity, rests_until_its_start) {
  const MotionPtr motion = constant_velocity({1, 2, 0}, {0, 0, 3}, 0.5);
  EXPECT_EQ(motion->at(0.4).position, Eigen::Vector3d::Zero());
  EXPECT_EQ(motion->at(0.4).velocity, Eigen::Vector3d::Zero());
  EXPECT_TRUE(motion->at(0.75).position.isApprox(Eigen::Vector3d(0.25, 0.5, 0), 1e-15));
  EXPECT_TRUE(motion->at(0.75).rotation.isApprox(Eigen::Vector3d(0, 0, 0.75), 1e-15));
  EXPECT_EQ(motion->at(0.75).velocity, Eigen::Vector3d(1, 2, 0));
  EXPECT_THROW(constant_velocity({1, 0, 0}, {0, 0, 0}, -1), MotionError);
}

TEST(Keyframes, pass_through_every_key) {
  const std::vector<Key> keys{key(0.1, 0), key(0.3, 0.2, 1), key(0.4, 0.1, 2), key(1, 0.5, -1)};
  const MotionPtr motion = keyframe_motion(keys);
  for (const Key& k : keys) {
    EXPECT_NEAR(motion->at(k.time).position.x(), k.position.x(), 1e-15);
    EXPECT_NEAR(motion->at(k.time).rotation.z(), k.angle, 1e-15);
  }
}

TEST(Keyframes, two_keys_make_the_smooth_step) {
  const MotionPtr motion = keyframe_motion({key(0, 0), key(2, 0.3)});
  for (const double s : {0.1, 0.25, 0.5, 0.9})
    EXPECT_NEAR(motion->at(2 * s).position.x(), 0.3 * s * s * (3 - 2 * s), 1e-15);
  EXPECT_NEAR(motion->at(1).velocity.x(), 0.3 * 1.5 / 2, 1e-15);
}

TEST(Keyframes, never_overshoot) {
  // The data of Fritsch and Carlson's paper (table RPN 14) and a plateau.
  const std::vector<Key> keys{key(7.99, 0),       key(8.09, 2.76429e-5), key(8.19, 4.37498e-2),
                              key(8.7, 0.169183), key(9.2, 0.469428),    key(10, 0.943740),
                              key(12, 0.998636),  key(15, 0.999919),     key(20, 0.999994),
                              key(21, 0.999994),  key(22, 0.5)};
  const MotionPtr motion = keyframe_motion(keys);
  for (std::size_t k = 0; k + 1 < keys.size(); ++k) {
    const double from = keys[k].position.x(), to = keys[k + 1].position.x();
    double before = from;
    for (int i = 1; i <= 500; ++i) {
      const double x = motion->at(keys[k].time + (keys[k + 1].time - keys[k].time) * i / 500).position.x();
      EXPECT_GE((x - before) * (to - from), -1e-15) << "between keys " << k << " and " << k + 1;
      before = x;
    }
  }
}

TEST(Keyframes, velocity_is_continuous_and_is_the_derivative_of_position) {
  const MotionPtr motion = keyframe_motion({key(0, 0), key(0.2, 0.1), key(0.5, 0.6), key(0.9, 0.7)});
  for (const double t : {0.0, 0.2, 0.5, 0.9}) {
    const double before = motion->at(std::max(t - 1e-9, 0.0)).velocity.x(),
                 after = motion->at(t + 1e-9).velocity.x();
    EXPECT_NEAR(before, after, 1e-6) << t;
  }
  for (double t = 0.013; t < 0.9; t += 0.05) {
    const double h = 1e-5;
    const auto x = [&](double time) { return motion->at(time).position.x(); };
    EXPECT_NEAR(motion->at(t).velocity.x(), (x(t + h) - x(t - h)) / (2 * h), 1e-7) << t;
    EXPECT_NEAR(motion->at(t).acceleration.x(), (x(t + h) - 2 * x(t) + x(t - h)) / (h * h), 1e-4) << t;
  }
}

TEST(Keyframes, rest_before_the_first_and_after_the_last) {
  const MotionPtr motion = keyframe_motion({key(0.5, 0), key(1, 0.4)});
  EXPECT_EQ(motion->at(0.2).position.x(), 0);
  EXPECT_EQ(motion->at(3).position.x(), 0.4);
  EXPECT_EQ(motion->at(3).velocity.x(), 0);
}

TEST(Keyframes, refuse_times_out_of_order) {
  try {
    keyframe_motion({key(0, 0), key(0.5, 1), key(0.5, 2)});
    FAIL();
  } catch (const MotionError& error) {
    EXPECT_EQ(error.part(), "key[2].time");
    EXPECT_THAT(error.what(), HasSubstr("0.5 s is not after 0.5 s"));
  }
  EXPECT_THROW(keyframe_motion({}), MotionError);
  EXPECT_THROW(keyframe_motion({key(-0.1, 0)}), MotionError);
}

TEST(Expression, is_its_formula) {
  const MotionPtr motion = expression_motion({"0.02*sin(2*pi*t)", "t^2", "", "0.1*(1-cos(t))"});
  for (const double t : {0.0, 1e-5, 0.3, 7.7}) {
    const Offset offset = motion->at(t);
    EXPECT_NEAR(offset.position.x(), 0.02 * std::sin(2 * kPi * t), 1e-17);
    EXPECT_NEAR(offset.position.y(), t * t, 1e-14);
    EXPECT_EQ(offset.position.z(), 0);
    EXPECT_NEAR(offset.rotation.z(), 0.1 * (1 - std::cos(t)), 1e-17);
  }
}

TEST(Expression, derivatives_are_as_good_as_documented) {
  const double A = 0.02, omega = 2 * kPi * 5;
  const MotionPtr motion = expression_motion({"0.02*sin(2*pi*5*t)", "", "", ""});
  for (const double t : {0.0, 1e-4, 5e-4, 0.123, 3.21}) {
    EXPECT_NEAR(motion->at(t).velocity.x(), A * omega * std::cos(omega * t), 1e-11) << t;
    EXPECT_NEAR(motion->at(t).acceleration.x(), -A * omega * omega * std::sin(omega * t),
                t < 6e-4 ? 3e-8 : 2e-9)
        << t;
  }
}

TEST(Expression, need_not_be_defined_before_time_zero) {
  const MotionPtr motion = expression_motion({"sqrt(t)^5", "", "", ""});  // t^2.5
  EXPECT_NO_THROW(static_cast<void>(motion->at(0)));
  EXPECT_NEAR(motion->at(1).acceleration.x(), 3.75, 1e-6);
}

std::string message_of(const Formulas& formulas, double t = -1) {
  try {
    const MotionPtr motion = expression_motion(formulas);
    if (t >= 0) (void)motion->at(t);
  } catch (const MotionError& error) {
    return error.part() + ": " + error.what();
  }
  return "";
}

TEST(Expression, errors_name_formula_position_and_token) {
  EXPECT_THAT(message_of({"0.1*foo(t)", "", "", ""}),
              HasSubstr("x: formula '0.1*foo(t)', position 5, token 'foo'"));
  EXPECT_THAT(message_of({"", "2*(t", "", ""}), HasSubstr("y: formula '2*(t'"));
  EXPECT_THAT(message_of({"", "", "", "t t"}), HasSubstr("angle: formula 't t', position 3, token 't'"));
  EXPECT_THAT(message_of({"t,2", "", "", ""}), HasSubstr("2 values; give one"));
  EXPECT_THAT(message_of({"t=1", "", "", ""}), HasSubstr("assigns to t"));
  EXPECT_EQ(message_of({"t < 1 ? 0 : t-1", "", "", ""}), "");
}

TEST(Expression, refuses_values_that_are_not_finite) {
  EXPECT_THAT(message_of({"1/(t-1)", "", "", ""}, 1), HasSubstr("formula '1/(t-1)' is inf at t = 1 s"));
  EXPECT_THAT(message_of({"", "log(t-1)", "", ""}, 0.5), HasSubstr("nan at t = 0."));
}

TEST(CheckStartsAtZero, names_the_offset) {
  EXPECT_NO_THROW(check_starts_at_zero(*expression_motion({"sin(t)", "", "", ""})));
  try {
    check_starts_at_zero(*expression_motion({"0.1*cos(t)", "", "", ""}));
    FAIL();
  } catch (const MotionError& error) {
    EXPECT_THAT(error.what(), HasSubstr("starts at offset (0.1, 0, 0) m"));
  }
  EXPECT_THROW(check_starts_at_zero(*keyframe_motion({key(0.5, 0.1), key(1, 0.2)})), MotionError);
}

// The derivatives that a motion reports are those of its offset.
void expect_consistent(const Motion& motion, const std::vector<double>& times) {
  const double h = 1e-5;
  for (const double t : times) {
    const Offset before = motion.at(t - h), now = motion.at(t), after = motion.at(t + h);
    EXPECT_TRUE(((after.position - before.position) / (2 * h)).isApprox(now.velocity, 1e-6)) << t;
    EXPECT_TRUE(((after.velocity - before.velocity) / (2 * h)).isApprox(now.acceleration, 1e-6)) << t;
    EXPECT_TRUE(((after.rotation - before.rotation) / (2 * h)).isApprox(now.angular_velocity, 1e-6)) << t;
    EXPECT_TRUE(((after.angular_velocity - before.angular_velocity) / (2 * h))
                    .isApprox(now.angular_acceleration, 1e-6))
        << t;
  }
}

TEST(Sinusoid, swings_from_its_start) {
  const MotionPtr motion = sinusoid_motion({{0.1, 0, 0}, 0.3, 2, 0.5, 0});
  EXPECT_EQ(motion->at(0.4).position, Eigen::Vector3d::Zero());
  EXPECT_NEAR(motion->at(0.5 + 0.125).position.x(), 0.1, 1e-15);
  EXPECT_NEAR(motion->at(0.5 + 0.375).rotation.z(), -0.3, 1e-15);
  expect_consistent(*motion, {0.55, 0.8, 1.3});
  EXPECT_THROW(sinusoid_motion({{0.1, 0, 0}, 0, 0, 0, 0}), MotionError);
}

TEST(Sinusoid, builds_up_without_a_jump) {
  const MotionPtr motion = sinusoid_motion({{0.1, 0.05, 0}, 0.2, 1.5, 0.2, 1});
  EXPECT_LT(motion->at(0.2 + 1e-4).acceleration.norm(), 1e-4);
  expect_consistent(*motion, {0.3, 0.7, 1.1, 1.5});
  EXPECT_NEAR(motion->at(1.2 + 0.5).position.x(), 0.1 * std::sin(2 * kPi * 1.5 * 1.5), 1e-12);
}

TEST(Ramp, goes_from_rest_to_rest) {
  const MotionPtr motion = ramp_motion({{0, 0.4, 0}, 1, 0.1, 0.5});
  EXPECT_EQ(motion->at(0.1).position, Eigen::Vector3d::Zero());
  EXPECT_NEAR(motion->at(0.35).position.y(), 0.2, 1e-15);
  EXPECT_EQ(motion->at(0.6).position, Eigen::Vector3d(0, 0.4, 0));
  EXPECT_LT(motion->at(0.6 - 1e-6).acceleration.norm(), 1e-3);
  expect_consistent(*motion, {0.15, 0.3, 0.5});
  EXPECT_THROW(ramp_motion({{0, 1, 0}, 0, 0, 0}), MotionError);
}

TEST(About, turns_about_any_axis_and_point) {
  const Eigen::Vector3d axis = Eigen::Vector3d(1, 2, -1).normalized(), arm(0.3, 0.1, 0.5);
  const MotionPtr motion = about_pivot(about_axis(ramp_motion({{0.1, 0, 0}, 2, 0, 1}), axis), arm);
  expect_consistent(*motion, {0.2, 0.4, 0.8});
  const Offset end = motion->at(1);
  EXPECT_TRUE(end.rotation.isApprox(2 * axis, 1e-14));
  const Eigen::Vector3d turned = rotation(2 * axis) * arm;
  EXPECT_TRUE(end.position.isApprox(Eigen::Vector3d(0.1, 0, 0) + turned - arm, 1e-14));
  EXPECT_EQ(motion->at(0).position.norm(), 0);
}

}  // namespace
}  // namespace sluice::rigid
