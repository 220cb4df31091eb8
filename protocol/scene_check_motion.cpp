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
    if (check.dimension() == 3 && key.angle() != 0)
      check.report(path + ".angle", "is for two dimensions; remove it");
  }
}

void check_expression(const Expression& motion, const std::string& field, FieldCheck& check) {
  if (motion.x().empty() && motion.y().empty() && motion.z().empty() && motion.angle().empty())
    check.report(field, "has no formula; give x, y, z or angle, e.g. x: \"0.02*sin(2*pi*t)\"");
  if (check.dimension() == 2 && !motion.z().empty())
    check.report(field + ".z", "does not exist in two dimensions; remove it");
  if (check.dimension() == 3 && !motion.angle().empty())
    check.report(field + ".angle", "is for two dimensions; remove it");
  for (const auto& [name, formula] : {std::pair{".x", &motion.x()}, std::pair{".y", &motion.y()},
                                      std::pair{".z", &motion.z()}, std::pair{".angle", &motion.angle()}}) {
    if (formula->size() > kLongestFormula)
      check.report(field + name, fmt::format("has {} characters, at most {} are supported; use keyframes",
                                             formula->size(), kLongestFormula));
  }
}

}  // namespace

void check_motion(const Motion& motion, const std::string& field, FieldCheck& check) {
  switch (motion.kind_case()) {
    case Motion::kConstant:
      return check_constant(motion.constant(), field + ".constant", check);
    case Motion::kKeyframes:
      return check_keyframes(motion.keyframes(), field + ".keyframes", check);
    case Motion::kExpression:
      return check_expression(motion.expression(), field + ".expression", check);
    case Motion::KIND_NOT_SET:
      check.report(field, "has no kind; give constant, keyframes or expression");
  }
}

}  // namespace sluice::protocol
