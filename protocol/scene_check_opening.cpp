#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "protocol/field_check.hpp"
#include "protocol/formula.hpp"
#include "protocol/scene_check.hpp"

namespace sluice::protocol {
namespace {

constexpr int kMostOpenings = 255;

// At time 0 and the origin; nothing where the formula is wrong, which is reported.
void check_formula(const std::string& text, const std::string& field, FieldCheck& check) {
  try {
    static_cast<void>(Formula(text, true).at({0, 0, 0}));
  } catch (const FormulaError& error) {
    check.report(field, error.what());
  }
}

void check_inflow(const Inflow& inflow, const std::string& field, const Scene& scene, FieldCheck& check) {
  check_formula(inflow.speed(), field + ".speed", check);
  check_formula(inflow.pressure(), field + ".pressure", check);
  if (inflow.speed().empty() && inflow.level().empty())
    check.report(field, "has neither speed nor level; give one of them, or both");
  if (inflow.speed().empty() && !inflow.pressure().empty())
    check.report(field + ".pressure", "needs a speed; give one, or a level instead of the pressure");
  if (!inflow.speed().empty() && !scene.liquid().has_max_speed())
    check.report(field + ".speed",
                 "needs liquid.max_speed: give the largest speed expected in the flow [m/s]");
}

// Height against gravity of the edges of the rectangle [m].
std::pair<double, double> edges(const Opening& opening, const Scene& scene, int axis) {
  double low = 0, high = 0;
  int entry = 0;
  for (int a = 0; a < scene.gravity_size(); ++a) {
    const double min = a == axis ? scene.domain().max(a) : opening.min(entry),
                 max = a == axis ? scene.domain().max(a) : opening.max(entry);
    if (a != axis) ++entry;
    double g = 0;
    for (const double x : scene.gravity()) g += x * x;
    const double up = -scene.gravity(a) / std::sqrt(g);
    low += std::min(up * min, up * max);
    high += std::max(up * min, up * max);
  }
  return {low, high};
}

// `given` is the scene with its defaults.
void check_level(const std::string& level, const std::string& pressure, const Opening& opening,
                 const std::string& field, const Scene& given, FieldCheck& check) {
  if (level.empty()) return;
  check_formula(level, field + ".level", check);
  if (!pressure.empty())
    check.report(field + ".level", "is given with a pressure, which it sets; leave one out");
  if (std::all_of(given.gravity().begin(), given.gravity().end(), [](double g) { return g == 0; }))
    return check.report(field + ".level", "needs gravity; give a pressure instead");
  if (!opening.has_inflow()) return;
  try {
    const double height = Formula(level, true).at({0, 0, 0});
    const auto [low, high] = edges(opening, given, (opening.side() - X_MIN) / 2);
    if (!(height > low))
      check.report(field + ".level",
                   fmt::format("{:g} m at t = 0 is not above the lower edge of the opening, {:g} "
                               "m, and nothing would come in; raise it",
                               height, low));
    else if (!(height < high) && opening.inflow().speed().empty())
      check.report(
          field + ".level",
          fmt::format("{:g} m at t = 0 is not below the upper edge of the opening, {:g} m: the opening "
                      "must reach above the liquid to see its surface; raise opening.max and the tank, "
                      "or give a speed",
                      height, high));
  } catch (const FormulaError&) {  // reported before
  }
}

bool check_rectangle(const Opening& opening, const std::string& field, const Scene& given,
                     FieldCheck& check) {
  const int axis = (opening.side() - X_MIN) / 2, entries = check.dimension() - 1;
  for (const auto& [corner, name] : {std::pair{&opening.min(), "min"}, std::pair{&opening.max(), "max"}})
    if (corner->size() != entries) {
      check.report(fmt::format("{}.{}", field, name),
                   fmt::format("has {} entries; along a side there are {}, in the order of the axes",
                               corner->size(), entries));
      return false;
    }
  const double tolerance = 1e-9 * given.spacing();
  for (int a = 0, entry = 0; a < check.dimension(); ++a) {
    if (a == axis) continue;
    const double low = opening.min(entry), high = opening.max(entry);
    const double tank_low = given.domain().min(a), tank_high = given.domain().max(a);
    if (!(high - low >= given.spacing() - tolerance))
      check.report(
          fmt::format("{}.max[{}]", field, entry),
          fmt::format("{:g} m is not a spacing above min, {:g} m; give a larger opening", high, low));
    if (low < tank_low - tolerance || high > tank_high + tolerance)
      check.report(fmt::format("{}.{}[{}]", field, low < tank_low - tolerance ? "min" : "max", entry),
                   fmt::format("{:g} to {:g} m is not within the tank, {:g} to {:g} m; shrink the opening",
                               low, high, tank_low, tank_high));
    ++entry;
  }
  return true;
}

bool overlap(const Opening& a, const Opening& b, double tolerance) {
  if (a.side() != b.side() || a.min_size() != b.min_size()) return false;
  for (int e = 0; e < a.min_size(); ++e)
    if (a.min(e) > b.max(e) - tolerance || b.min(e) > a.max(e) - tolerance) return false;
  return true;
}

void check_side_of(const Opening& opening, const std::string& field, const Scene& given, FieldCheck& check) {
  const auto axis = static_cast<Axis>(X_AXIS + (opening.side() - X_MIN) / 2);
  const auto& periodic = given.domain().periodic();
  if (std::find(periodic.begin(), periodic.end(), axis) != periodic.end())
    check.report(field + ".side",
                 fmt::format("{} is periodic and has no sides; choose another", Axis_Name(axis)));
}

void check_formulation_of(const Scene& given, FieldCheck& check) {
  const Formulation& formulation = given.formulation();
  if (formulation.integrator() != KICK_DRIFT_KICK)
    check.report("formulation.integrator", "openings are built for KICK_DRIFT_KICK only; leave it out");
  if (formulation.quadrature() != NODAL)
    check.report("formulation.quadrature", "openings are built for NODAL only; leave it out");
  if (formulation.interpolated_motion() > 0)
    check.report("formulation.interpolated_motion", "openings are not built for it; leave it out");
}

}  // namespace

void check_openings(const Scene& scene, FieldCheck& check) {
  if (scene.opening_size() == 0 || !check.count(scene.opening_size(), kMostOpenings, "opening")) return;
  if (scene.domain().max_size() != check.dimension() || !(scene.spacing() > 0)) return;  // reported elsewhere
  const Scene given = with_defaults(scene);
  check_formulation_of(given, check);
  std::map<std::string, int> seen;
  for (int o = 0; o < scene.opening_size(); ++o) {
    const Opening& opening = given.opening(o);
    const std::string field = fmt::format("opening[{}]", o);
    if (opening.name().empty()) check.report(field + ".name", "is missing; name the opening");
    if (const auto [first, fresh] = seen.emplace(opening.name(), o); !fresh)
      check.report(field + ".name", fmt::format("\"{}\" is the name of opening[{}] too; names must differ",
                                                opening.name(), first->second));
    if (!check_side(opening.side(), field + ".side", check)) continue;
    check_side_of(opening, field, given, check);
    if (!check_rectangle(opening, field, given, check)) continue;
    for (int other = 0; other < o; ++other)
      if (overlap(opening, given.opening(other), 1e-9 * given.spacing()))
        check.report(field, fmt::format("overlaps opening[{}]; let them touch at most", other));
    switch (opening.kind_case()) {
      case Opening::kInflow:
        check_inflow(opening.inflow(), field + ".inflow", scene, check);
        check_level(opening.inflow().level(), opening.inflow().pressure(), opening, field + ".inflow", given,
                    check);
        break;
      case Opening::kOutflow:
        check_formula(opening.outflow().pressure(), field + ".outflow.pressure", check);
        check_level(opening.outflow().level(), opening.outflow().pressure(), opening, field + ".outflow",
                    given, check);
        break;
      case Opening::KIND_NOT_SET:
        check.report(field, "has no kind; give inflow or outflow");
    }
  }
}

}  // namespace sluice::protocol
