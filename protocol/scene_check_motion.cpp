#include <fmt/format.h>

#include <limits>

#include "protocol/field_check.hpp"

namespace sluice::protocol {
namespace {

constexpr int kMostKeys = 20'000;
constexpr std::size_t kLongestFormula = 1000;

void check_constant(const ConstantVelocity& motion, const std::string& field, FieldCheck& check) {
  check.optional_vector(motion.velocity(), field + ".velocity", "the velocity");
  check.optional_rotation(motion.angular_velocity(), field + ".angular_velocity", "the angular velocity");
  check.not_negative(motion.start(), field + ".start", "s");
}

void check_keyframes(const Keyframes& motion, const std::string& field, FieldCheck& check) {
  if (motion.key().empty()) check.report(field, "has no key; give at least one time with its offset");
  if (!check.count(motion.key_size(), kMostKeys, field + ".key")) return;
  double previous = -std::numeric_limits<double>::infinity();
  for (int i = 0; i < motion.key_size(); ++i) {
    const Keyframe& key = motion.key(i);
    const std::string path = fmt::format("{}.key[{}]", field, i);
    check.not_negative(key.time(), path + ".time", "s");
    if (key.time() <= previous)
      check.report(path + ".time", fmt::format("{} s is not after the key before, {} s; times must increase",
                                               key.time(), previous));
    previous = key.time();
    check.optional_vector(key.offset(), path + ".offset", "the offset");
  }
}

void check_expression(const Expression& motion, const std::string& field, FieldCheck& check) {
  if (motion.x().empty() && motion.y().empty() && motion.z().empty() && motion.angle().empty())
    check.report(field, "has no formula; give x, y, z or angle, e.g. x: \"0.02*sin(2*pi*t)\"");
  if (check.dimension() == 2 && !motion.z().empty())
    check.report(field + ".z", "does not exist in two dimensions; remove it");
  for (const auto& [name, formula] : {std::pair{".x", &motion.x()}, std::pair{".y", &motion.y()},
                                      std::pair{".z", &motion.z()}, std::pair{".angle", &motion.angle()}}) {
    if (formula->size() > kLongestFormula)
      check.report(field + name, fmt::format("has {} characters, at most {} are supported; use keyframes",
                                             formula->size(), kLongestFormula));
  }
}

void check_sinusoid(const Sinusoid& motion, const std::string& field, FieldCheck& check) {
  check.optional_vector(motion.offset(), field + ".offset", "the amplitude");
  check.positive(motion.frequency(), field + ".frequency", "1/s", "give the number of swings per second");
  check.not_negative(motion.start(), field + ".start", "s");
  check.not_negative(motion.build_up(), field + ".build_up", "s");
}

void check_ramp(const Ramp& motion, const std::string& field, FieldCheck& check) {
  check.optional_vector(motion.offset(), field + ".offset", "the offset at the end");
  check.not_negative(motion.start(), field + ".start", "s");
  check.positive(motion.duration(), field + ".duration", "s", "give the time from start to end");
}

void check_axis(const Motion& motion, const std::string& field, FieldCheck& check) {
  const std::string path = field + ".axis";
  if (motion.axis().empty()) return;
  if (check.dimension() == 2) return check.report(path, "is for three dimensions; in two it is z, remove it");
  if (motion.has_constant())
    return check.report(path, "goes with angles; a constant motion has its axis in angular_velocity");
  if (!check.vector(motion.axis(), path, "the axis of rotation")) return;
  if (motion.axis(0) == 0 && motion.axis(1) == 0 && motion.axis(2) == 0)
    check.report(path, "is zero; give a direction, such as [0, 1, 0]");
}

void check_kind(const Motion& motion, const std::string& field, FieldCheck& check) {
  switch (motion.kind_case()) {
    case Motion::kConstant:
      return check_constant(motion.constant(), field + ".constant", check);
    case Motion::kKeyframes:
      return check_keyframes(motion.keyframes(), field + ".keyframes", check);
    case Motion::kExpression:
      return check_expression(motion.expression(), field + ".expression", check);
    case Motion::kSinusoid:
      return check_sinusoid(motion.sinusoid(), field + ".sinusoid", check);
    case Motion::kRamp:
      return check_ramp(motion.ramp(), field + ".ramp", check);
    case Motion::KIND_NOT_SET:
      check.report(field, "has no kind; give constant, keyframes, expression, sinusoid or ramp");
  }
}

}  // namespace

void check_motion(const Motion& motion, const std::string& field, FieldCheck& check) {
  check_kind(motion, field, check);
  check_axis(motion, field, check);
  check.optional_vector(motion.pivot(), field + ".pivot", "the pivot");
  if (motion.has_release()) check.not_negative(motion.release(), field + ".release", "s");
}

}  // namespace sluice::protocol
