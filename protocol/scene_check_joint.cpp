#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "protocol/body_kind.hpp"
#include "protocol/field_check.hpp"

namespace sluice::protocol {
namespace {

constexpr int kMostJoints = 1000;

void check_axis(const Vector& axis, bool needed, const std::string& field, FieldCheck& check) {
  if (axis.empty() && !needed) return;
  if (!check.vector(axis, field, "the axis")) return;
  if (std::all_of(axis.begin(), axis.end(), [](double x) { return x == 0; }))
    check.report(field, "is zero; give a direction");
}

// What hinge and slider share.
template <typename Kind>
void check_drive(const Kind& kind, double most, const std::string& field, FieldCheck& check) {
  for (const auto& [given, value, name] : {std::tuple{kind.has_lower(), kind.lower(), ".lower"},
                                           std::tuple{kind.has_upper(), kind.upper(), ".upper"}}) {
    if (given && std::abs(value) > most)
      check.report(field + name, fmt::format("{} is beyond half a turn, {:.6g} rad", value, most));
  }
  if (kind.has_lower() && kind.lower() > 0)
    check.report(field + ".lower", fmt::format("{} is above 0, where the joint starts", kind.lower()));
  if (kind.has_upper() && kind.upper() < 0)
    check.report(field + ".upper", fmt::format("{} is below 0, where the joint starts", kind.upper()));
  if (kind.has_motor())
    check.positive(kind.motor().strength(), field + ".motor.strength", "N or N m",
                   "give the largest force or moment of the motor");
  check.not_negative(kind.stiffness(), field + ".stiffness", "N/m or N m/rad");
  check.not_negative(kind.damping(), field + ".damping", "N s/m or N m s/rad");
}

void check_kind(const Hinge& hinge, const std::string& field, FieldCheck& check) {
  check.vector(hinge.point(), field + ".point", "a point of the axis");
  if (check.dimension() == 2 && !hinge.axis().empty())
    check.report(field + ".axis", "is for three dimensions; in two it is z, remove it");
  else
    check_axis(hinge.axis(), false, field + ".axis", check);
  check_drive(hinge, std::numbers::pi, field, check);
}

void check_kind(const Slider& slider, const std::string& field, FieldCheck& check) {
  check_axis(slider.axis(), true, field + ".axis", check);
  check_drive(slider, std::numeric_limits<double>::infinity(), field, check);
}

void check_kind(const Spring& spring, const std::string& field, FieldCheck& check) {
  check.vector(spring.from(), field + ".from", "the spring's end on the body");
  check.vector(spring.to(), field + ".to", "the spring's other end");
  check.not_negative(spring.stiffness(), field + ".stiffness", "N/m");
  check.not_negative(spring.damping(), field + ".damping", "N s/m");
  if (spring.has_length()) check.not_negative(spring.length(), field + ".length", "m");
}

const Body* find(const Scene& scene, const std::string& name) {
  for (const Body& body : scene.body())
    if (body.name() == name) return &body;
  return nullptr;
}

void check_ends(const Joint& joint, const Scene& scene, const std::string& field, FieldCheck& check) {
  const Body* body = find(scene, joint.body());
  const Body* to = joint.to().empty() ? nullptr : find(scene, joint.to());
  if (body == nullptr)
    return check.report(field + ".body", fmt::format("there is no body \"{}\"; name one", joint.body()));
  if (to == nullptr && !joint.to().empty())
    return check.report(
        field + ".to",
        fmt::format("there is no body \"{}\"; name one, or leave it out for the world", joint.to()));
  if (body == to) return check.report(field + ".to", "is the same body; name another");
  if (to != nullptr && body->owner() != to->owner())
    return check.report(field,
                        fmt::format("joins bodies of two owners, \"{}\" and \"{}\"; who moves one of them "
                                    "does not know the other",
                                    body->owner(), to->owner()));
  if (!is_ever_free(*body) && (to == nullptr || !is_ever_free(*to)))
    check.report(field, "joins nothing that is free to move; remove it");
}

}  // namespace

void check_joints(const Scene& scene, FieldCheck& check) {
  if (!check.count(scene.joint_size(), kMostJoints, "joint")) return;
  for (int j = 0; j < scene.joint_size(); ++j) {
    const Joint& joint = scene.joint(j);
    const std::string field = fmt::format("joint[{}]", j);
    check_ends(joint, scene, field, check);
    switch (joint.kind_case()) {
      case Joint::kHinge:
        check_kind(joint.hinge(), field + ".hinge", check);
        break;
      case Joint::kSlider:
        check_kind(joint.slider(), field + ".slider", check);
        break;
      case Joint::kSpring:
        check_kind(joint.spring(), field + ".spring", check);
        break;
      case Joint::kFixed:
        break;
      case Joint::KIND_NOT_SET:
        check.report(field, "has no kind; give hinge, slider, fixed or spring");
    }
  }
}

void check_contact(const Contact& contact, const std::string& field, FieldCheck& check) {
  check.not_negative(contact.friction(), field + ".friction", "as a coefficient");
  check.within(contact.restitution(), 0, 1, field + ".restitution");
}

}  // namespace sluice::protocol
