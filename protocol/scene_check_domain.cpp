#include <fmt/format.h>

#include <cmath>
#include <set>

#include "protocol/field_check.hpp"

namespace sluice::protocol {

namespace {

// Neighbours are looked for up to 2.3 h away, and their images as far again.
constexpr double kPeriodInSmoothings = 4.6;

void check_open_sides(const Domain& domain, FieldCheck& check) {
  std::set<int> seen;
  for (int i = 0; i < domain.open_size(); ++i) {
    const Side side = domain.open(i);
    const std::string field = fmt::format("domain.open[{}]", i);
    if (check_side(side, field, check) && !seen.insert(side).second)
      check.report(field, fmt::format("{} is given twice; remove one", Side_Name(side)));
  }
}

double lower(const Domain& domain, int axis) {
  return axis < domain.min_size() ? domain.min(axis) : 0;
}

// A lattice goes on through a periodic side only if it fits; and fluid must not see its own image.
void check_period(const Scene& scene, int axis, const std::string& field, FieldCheck& check) {
  const double length = scene.domain().max(axis) - lower(scene.domain(), axis), spacing = scene.spacing();
  const double smoothing = scene.formulation().has_smoothing() ? scene.formulation().smoothing() : 1.5;
  const double cells = length / spacing, least = kPeriodInSmoothings * smoothing;
  if (!(std::abs(cells - std::round(cells)) < 1e-6))
    check.report(field, fmt::format("the tank's length along it, {} m, is {} spacings; give a whole number",
                                    length, cells));
  else if (cells < least)
    check.report(field, fmt::format("the tank's length along it, {} m, is {} spacings; give at least {:.0f}",
                                    length, cells, std::ceil(least)));
}

void check_periodic(const Scene& scene, FieldCheck& check) {
  const Domain& domain = scene.domain();
  std::set<int> seen;
  for (int i = 0; i < domain.periodic_size(); ++i) {
    const Axis axis = domain.periodic(i);
    const std::string field = fmt::format("domain.periodic[{}]", i);
    if (!Axis_IsValid(axis) || axis == AXIS_UNSPECIFIED)
      check.report(field,
                   fmt::format("{} is not an axis; give X_AXIS, Y_AXIS or Z_AXIS", static_cast<int>(axis)));
    else if (check.dimension() == 2 && axis == Z_AXIS)
      check.report(field, "Z_AXIS does not exist in two dimensions; remove it");
    else if (!seen.insert(axis).second)
      check.report(field, fmt::format("{} is given twice; remove one", Axis_Name(axis)));
    else if (axis - X_AXIS < domain.max_size())
      check_period(scene, axis - X_AXIS, field, check);
  }
  for (int i = 0; i < domain.open_size(); ++i)
    if (seen.contains(X_AXIS + (domain.open(i) - X_MIN) / 2))
      check.report(fmt::format("domain.open[{}]", i), "the axis is periodic and has no sides; remove it");
}

void check_moving(const Domain& domain, FieldCheck& check) {
  for (int i = 0; i < domain.moving_size(); ++i) {
    const WallMotion& motion = domain.moving(i);
    const std::string field = fmt::format("domain.moving[{}]", i);
    if (!check_side(motion.side(), field + ".side", check)) continue;
    if (!check.vector(motion.velocity(), field + ".velocity", "the wall's velocity")) continue;
    const int axis = (motion.side() - X_MIN) / 2;
    if (motion.velocity(axis) != 0)
      check.report(
          fmt::format("{}.velocity[{}]", field, axis),
          fmt::format("{} m/s is across the wall, which may only move along itself; give 0, or use a "
                      "body with prescribed motion",
                      motion.velocity(axis)));
  }
}

}  // namespace

bool check_side(Side side, const std::string& field, FieldCheck& check) {
  if (!Side_IsValid(side) || side == SIDE_UNSPECIFIED)
    check.report(field, fmt::format("{} is not a side; give X_MIN, X_MAX, Y_MIN, Y_MAX, Z_MIN or Z_MAX",
                                    static_cast<int>(side)));
  else if (check.dimension() == 2 && side >= Z_MIN)
    check.report(field, fmt::format("{} does not exist in two dimensions; remove it", Side_Name(side)));
  else
    return true;
  return false;
}

void check_domain(const Scene& scene, FieldCheck& check) {
  const Domain& domain = scene.domain();
  check.optional_vector(domain.min(), "domain.min", "the tank's lower corner");
  check_open_sides(domain, check);
  check_moving(domain, check);
  if (!check.vector(domain.max(), "domain.max", "the tank's upper corner")) return;
  for (int a = 0; a < domain.max_size(); ++a) {
    const double low = lower(domain, a);
    const double edge = domain.max(a) - low;
    if (edge <= 0 || (edge < scene.spacing() && std::isfinite(scene.spacing())))
      check.report(fmt::format("domain.max[{}]", a),
                   fmt::format("{} m is not a spacing above the lower corner at {} m; give a larger tank",
                               domain.max(a), low));
  }
  if (scene.spacing() > 0) check_periodic(scene, check);
}

}  // namespace sluice::protocol
