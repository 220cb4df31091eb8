// Axes along and about which bodies are locked, or free beside a prescribed motion.
#include <fmt/format.h>

#include <algorithm>

#include "protocol/body_kind.hpp"
#include "protocol/field_check.hpp"

namespace sluice::protocol {
namespace {

using Axes = google::protobuf::RepeatedField<int>;

void check_exist(const Axes& axes, const std::string& path, bool turns, FieldCheck& check) {
  for (int i = 0; i < axes.size(); ++i) {
    const std::string entry = fmt::format("{}[{}]", path, i);
    const bool in_plane = turns ? axes[i] == Z_AXIS : axes[i] == X_AXIS || axes[i] == Y_AXIS;
    if (axes[i] < X_AXIS || axes[i] > Z_AXIS)
      check.report(entry, "is no axis; give X_AXIS, Y_AXIS or Z_AXIS");
    else if (check.dimension() == 2 && !in_plane)
      check.report(entry, turns ? "does not exist in two dimensions, where bodies turn about Z_AXIS"
                                : "does not exist in two dimensions; remove it");
  }
}

void check_locks(const Body& body, const std::string& field, FieldCheck& check) {
  check_exist(body.locked(), field + ".locked", false, check);
  check_exist(body.locked_rotation(), field + ".locked_rotation", true, check);
  if (is_ever_free(body)) return;
  for (const auto& [name, axes] :
       {std::pair{".locked", &body.locked()}, std::pair{".locked_rotation", &body.locked_rotation()}})
    if (!axes->empty())
      check.report(field + name, "is for free bodies; the motion of this one is prescribed, remove it");
}

bool has(const Axes& axes, int axis) {
  return std::find(axes.begin(), axes.end(), axis) != axes.end();
}

double entry(const Vector& vector, int i) {
  return i < vector.size() ? vector[i] : 0;
}

// Whether the motion goes along the axis `a`, 0 to 2.
bool goes_along(const Motion& motion, int a) {
  const auto& keys = motion.keyframes().key();
  const Expression& formulas = motion.expression();
  const std::string* formula[] = {&formulas.x(), &formulas.y(), &formulas.z()};
  return entry(motion.constant().velocity(), a) != 0 || entry(motion.sinusoid().offset(), a) != 0 ||
         entry(motion.ramp().offset(), a) != 0 || !formula[a]->empty() ||
         std::any_of(keys.begin(), keys.end(),
                     [a](const Keyframe& key) { return entry(key.offset(), a) != 0; });
}

bool has_angle(const Motion& motion) {
  const auto& keys = motion.keyframes().key();
  return motion.sinusoid().angle() != 0 || motion.ramp().angle() != 0 ||
         !motion.expression().angle().empty() ||
         std::any_of(keys.begin(), keys.end(), [](const Keyframe& key) { return key.angle() != 0; });
}

bool turns_about(const Motion& motion, int a, int dimension) {
  const Vector& turn = motion.constant().angular_velocity();
  if (motion.has_constant()) return dimension == 2 ? a == 2 && entry(turn, 0) != 0 : entry(turn, a) != 0;
  return has_angle(motion) && (motion.axis().empty() ? a == 2 : entry(motion.axis(), a) != 0);
}

void check_free(const Axes& axes, const Axes& locked, const std::string& path, const auto& moves,
                FieldCheck& check) {
  for (int i = 0; i < axes.size(); ++i) {
    if (axes[i] < X_AXIS || axes[i] > Z_AXIS) continue;
    if (has(locked, axes[i]))
      check.report(fmt::format("{}[{}]", path, i), "is locked too; remove one of them");
    if (moves(axes[i] - X_AXIS))
      check.report(
          fmt::format("{}[{}]", path, i),
          "is where the prescribed motion moves the body; leave that out of the motion, or this axis here");
  }
}

}  // namespace

void check_axes(const Body& body, const std::string& field, FieldCheck& check) {
  check_locks(body, field, check);
  if (body.free().empty() && body.free_rotation().empty()) return;
  if (!body.has_prescribed())
    return check.report(field + (body.free().empty() ? ".free_rotation" : ".free"),
                        "is for bodies with a prescribed motion; this one is free along all axes, remove it");
  const Motion& motion = body.prescribed();
  check_exist(body.free(), field + ".free", false, check);
  check_exist(body.free_rotation(), field + ".free_rotation", true, check);
  check_free(
      body.free(), body.locked(), field + ".free", [&](int a) { return goes_along(motion, a); }, check);
  check_free(
      body.free_rotation(), body.locked_rotation(), field + ".free_rotation",
      [&](int a) { return turns_about(motion, a, check.dimension()); }, check);
  if (!motion.pivot().empty())
    check.report(
        field + ".prescribed.pivot",
        "moves the centre of mass by the angle, which a body that is free along or about some axes does not "
        "follow; remove it, or hold the body by a joint");
}

}  // namespace sluice::protocol
