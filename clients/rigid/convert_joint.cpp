#include "clients/rigid/convert_joint.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "clients/rigid/convert.hpp"

namespace sluice::clients {
namespace {

using Kind = rigid::JointSpec::Kind;

std::size_t index_of(const std::string& name, const Scene& scene) {
  if (name.empty()) return rigid::kWorld;
  for (int b = 0; b < scene.body_size(); ++b)
    if (scene.body(b).name() == name) return static_cast<std::size_t>(b);
  throw std::invalid_argument(fmt::format("a joint names body '{}', which the scene does not have", name));
}

template <typename Drive>
void set_drive(const Drive& drive, rigid::JointSpec& spec) {
  if (drive.has_lower()) spec.lower = drive.lower();
  if (drive.has_upper()) spec.upper = drive.upper();
  if (drive.has_motor())
    spec.motor = rigid::JointSpec::Motor{drive.motor().speed(), drive.motor().strength()};
  spec.stiffness = drive.stiffness();
  spec.damping = drive.damping();
  spec.rest = drive.rest();
  if (!drive.axis().empty()) spec.axis = to_vector(drive.axis()).normalized();
}

}  // namespace

rigid::JointSpec to_joint(const Joint& joint, const Scene& scene) {
  rigid::JointSpec spec;
  spec.a = index_of(joint.body(), scene);
  spec.b = index_of(joint.to(), scene);
  spec.point = to_vector(scene.body(static_cast<int>(spec.a)).position());
  if (joint.has_hinge()) {
    spec.kind = Kind::hinge;
    spec.point = to_vector(joint.hinge().point());
    set_drive(joint.hinge(), spec);
  } else if (joint.has_slider()) {
    spec.kind = Kind::slider;
    set_drive(joint.slider(), spec);
  } else if (joint.has_spring()) {
    spec.kind = Kind::spring;
    spec.point = to_vector(joint.spring().from());
    spec.other_end = to_vector(joint.spring().to());
    spec.stiffness = joint.spring().stiffness();
    spec.damping = joint.spring().damping();
    if (joint.spring().has_length()) spec.rest = joint.spring().length();
  }
  return spec;
}

}  // namespace sluice::clients
