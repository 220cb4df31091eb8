#include <gmock/gmock.h>

#include "scene_text.hpp"

namespace sluice::protocol {
namespace {

using testing::HasSubstr;

TEST(Joints, RightOnesPass) {
  EXPECT_EQ(errors_of(kScene + R"(
joint { body: "gate" hinge { point: [0.5, 0.2] lower: -1 upper: 1 damping: 3 motor { speed: 1 strength: 2 } } }
joint { body: "gate" to: "ball" spring { from: [0.5, 0.3] to: [0.8, 0.3] stiffness: 10 } }
joint { name: "rail" body: "gate" slider { axis: [0, 1] } }
joint { body: "gate" to: "ball" fixed { } }
contact { friction: 0.1 restitution: 1 })"),
            "");
}

struct Wrong {
  const char* joint;
  const char* error;
};

TEST(Joints, WrongOnesAreReportedWithTheirPlace) {
  for (const auto& [joint, error] :
       {Wrong{"body: \"gate\"", "a.scene:21:1: joint[0]: has no kind; give hinge, slider, fixed or spring"},
        Wrong{"body: \"boat\" fixed { }", "a.scene:21:9: joint[0].body: there is no body \"boat\"; name one"},
        Wrong{"body: \"gate\" to: \"gate\" fixed { }", "joint[0].to: is the same body; name another"},
        Wrong{"body: \"ball\" fixed { }", "joint[0]: joins nothing that is free to move; remove it"},
        Wrong{"body: \"gate\" hinge { }",
              "joint[0].hinge.point: is missing; give a point of the axis with 2 entries"},
        Wrong{"body: \"gate\" hinge { point: [0, 0] axis: [0, 0, 1] }",
              "joint[0].hinge.axis: is for three dimensions; in two it is z, remove it"},
        Wrong{"body: \"gate\" hinge { point: [0, 0] upper: 4 }",
              "joint[0].hinge.upper: 4 is beyond half a turn, 3.14159 rad"},
        Wrong{"body: \"gate\" hinge { point: [0, 0] lower: 0.1 }",
              "joint[0].hinge.lower: 0.1 is above 0, where the joint starts"},
        Wrong{"body: \"gate\" slider { axis: [0, 0] }", "joint[0].slider.axis: is zero; give a direction"},
        Wrong{"body: \"gate\" slider { axis: [1, 0] motor { speed: 1 } }",
              "joint[0].slider.motor.strength: 0 N or N m is not positive"},
        Wrong{"body: \"gate\" spring { from: [0, 0] to: [1, 0] stiffness: -1 }",
              "joint[0].spring.stiffness: -1 N/m is negative; give 0 or more"}})
    EXPECT_THAT(errors_of(kScene + "joint { " + joint + " }"), HasSubstr(error)) << joint;
}

TEST(Bodies, LocksContactAndInertiaAreChecked) {
  const auto errors = [](const std::string& line) {
    return errors_of(with_line(12, "  density: 500 " + line));
  };
  EXPECT_EQ(errors("locked: [X_AXIS] locked_rotation: [Z_AXIS] inertia: 3 center_of_mass: [0, 0.01]"), "");
  EXPECT_THAT(errors("locked: [Z_AXIS]"), HasSubstr("body[0].locked[0]: does not exist in two dimensions"));
  EXPECT_THAT(errors("locked_rotation: [X_AXIS]"), HasSubstr("body[0].locked_rotation[0]: does not exist"));
  EXPECT_THAT(errors("contact { restitution: 1.5 }"),
              HasSubstr("body[0].contact.restitution: 1.5 is outside 0 to 1"));
  EXPECT_THAT(errors("contact { friction: -1 }"), HasSubstr("body[0].contact.friction: -1"));
  EXPECT_THAT(errors("inertia: [1, 2]"), HasSubstr("body[0].inertia: 2 entries; give one, about z"));
  EXPECT_THAT(errors("inertia: [0]"), HasSubstr("body[0].inertia[0]: 0 kg m^2 is not positive"));
  EXPECT_THAT(
      errors_of(with_line(12, "  prescribed { ramp { duration: 1 } release: 1 }")),
      HasSubstr("body[0].prescribed.release: makes the body free, which has neither density nor mass"));
}

TEST(Bodies, AxesBesideAPrescribedMotionAreChecked) {
  const auto errors = [](const std::string& line) {
    return errors_of(with_line(12, "  density: 500 prescribed { constant { velocity: [1, 0] } } " + line));
  };
  EXPECT_EQ(errors("free: [Y_AXIS] free_rotation: [Z_AXIS] velocity: [0, 2] angular_velocity: 1"), "");
  EXPECT_THAT(errors("free: [X_AXIS]"),
              HasSubstr("body[0].free[0]: is where the prescribed motion moves the body"));
  EXPECT_THAT(errors("free: [Z_AXIS]"), HasSubstr("body[0].free[0]: does not exist in two dimensions"));
  EXPECT_THAT(errors("free: [Y_AXIS] locked: [Y_AXIS]"), HasSubstr("body[0].free[0]: is locked too"));
  EXPECT_THAT(errors("free: [Y_AXIS] velocity: [1, 2]"),
              HasSubstr("body[0].velocity[0]: is along an axis that the motion prescribes"));
  EXPECT_THAT(errors("velocity: [0, 2]"), HasSubstr("body[0].velocity: is for free bodies"));
  EXPECT_THAT(errors_of(with_line(12, "  density: 500 free: [Y_AXIS]")),
              HasSubstr("body[0].free: is for bodies with a prescribed motion"));
  const auto of_motion = [](const std::string& motion) {
    return errors_of(with_line(12, "  density: 500 free_rotation: [Z_AXIS] prescribed { " + motion + " }"));
  };
  EXPECT_EQ(of_motion("sinusoid { offset: [0.1, 0] frequency: 1 }"), "");
  for (const char* motion : {"sinusoid { angle: 0.1 frequency: 1 }", "ramp { angle: 0.1 duration: 1 }",
                             "expression { angle: \"t\" }", "constant { angular_velocity: 1 }",
                             "keyframes { key { time: 1 angle: 1 } }"})
    EXPECT_THAT(of_motion(motion),
                HasSubstr("body[0].free_rotation[0]: is where the prescribed motion moves"))
        << motion;
  EXPECT_THAT(of_motion("constant { velocity: [1, 0] } pivot: [0, 0]"),
              HasSubstr("body[0].prescribed.pivot: moves the centre of mass by the angle"));
  EXPECT_THAT(errors_of(with_line(12, "  free: [Y_AXIS] prescribed { constant { velocity: [1, 0] } }")),
              HasSubstr("body[0]: makes the body free, which has neither density nor mass"));
}

TEST(Motions, NewKindsAreChecked) {
  const auto errors = [](const std::string& motion) {
    return errors_of(with_line(12, "  prescribed { " + motion + " }"));
  };
  EXPECT_EQ(errors("sinusoid { offset: [0.1, 0] frequency: 2 build_up: 1 } pivot: [0, 0]"), "");
  EXPECT_EQ(errors("ramp { angle: 1 duration: 2 }"), "");
  EXPECT_THAT(errors("sinusoid { offset: [0.1, 0] }"),
              HasSubstr("sinusoid.frequency: 0 1/s is not positive"));
  EXPECT_THAT(errors("ramp { angle: 1 }"), HasSubstr("ramp.duration: 0 s is not positive"));
  EXPECT_THAT(errors("ramp { duration: 1 } axis: [1, 0, 0]"),
              HasSubstr("prescribed.axis: is for three dimensions"));
  EXPECT_THAT(errors("ramp { duration: 1 } pivot: [1]"), HasSubstr("prescribed.pivot: 1 entries"));
}

TEST(Probes, AreChecked) {
  const auto errors = [](const std::string& probe) { return errors_of(kScene + "probe { " + probe + " }"); };
  EXPECT_EQ(errors("name: \"a\" point { position: [0.1, 0.1] body: \"gate\" }"), "");
  EXPECT_EQ(errors("name: \"a\" surface { position: [0.1, 0] }"), "");
  EXPECT_EQ(errors("name: \"a\" force { body: \"gate\" }"), "");
  EXPECT_THAT(errors("name: \"a\""), HasSubstr("probe[0]: has no kind; give point, surface, force or flow"));
  EXPECT_THAT(errors("point { position: [0, 0] }"), HasSubstr("probe[0].name: is missing; name the probe"));
  EXPECT_THAT(errors("name: \"a\" point { }"), HasSubstr("probe[0].point.position: is missing"));
  EXPECT_THAT(errors("name: \"a\" force { }"),
              HasSubstr("probe[0].force.body: there is no body \"\"; name one"));
  EXPECT_THAT(errors("name: \"a\" force { body: \"gate\" } } probe { name: \"a\" force { body: \"gate\" }"),
              HasSubstr("probe[1].name: \"a\" is the name of probe[0] too; names must differ"));
}

}  // namespace
}  // namespace sluice::protocol
