#include <fmt/format.h>

#include <cmath>

#include "protocol/field_check.hpp"
#include "protocol/formula.hpp"

namespace sluice::protocol {
namespace {

constexpr int kMostVertices = 1000;
constexpr std::size_t kLongestFormula = 20'000;  // a double series of some hundred terms

double cross(const Point& origin, const Point& a, const Point& b) {
  return (a.x() - origin.x()) * (b.y() - origin.y()) - (a.y() - origin.y()) * (b.x() - origin.x());
}

bool between(double a, double x, double b) {
  return (a <= x && x <= b) || (b <= x && x <= a);
}

// Whether c, known to be in line with a and b, lies from a to b.
bool on_segment(const Point& a, const Point& b, const Point& c) {
  return between(a.x(), c.x(), b.x()) && between(a.y(), c.y(), b.y());
}

bool segments_meet(const Point& a, const Point& b, const Point& c, const Point& d) {
  const double abc = cross(a, b, c);
  const double abd = cross(a, b, d);
  const double cda = cross(c, d, a);
  const double cdb = cross(c, d, b);
  if (((abc > 0) != (abd > 0)) && ((cda > 0) != (cdb > 0)) && abc != 0 && abd != 0 && cda != 0 && cdb != 0)
    return true;
  return (abc == 0 && on_segment(a, b, c)) || (abd == 0 && on_segment(a, b, d)) ||
         (cda == 0 && on_segment(c, d, a)) || (cdb == 0 && on_segment(c, d, b));
}

// The vertex with wrap-around.
const Point& vertex(const Polygon& polygon, int i) {
  return polygon.vertex(i % polygon.vertex_size());
}

void check_crossings(const Polygon& polygon, const std::string& field, FieldCheck& check) {
  const int n = polygon.vertex_size();
  for (int i = 0; i < n; ++i) {
    for (int j = i + 2; j < n; ++j) {
      if (i == 0 && j == n - 1) continue;  // neighbours around the end
      if (!segments_meet(vertex(polygon, i), vertex(polygon, i + 1), vertex(polygon, j),
                         vertex(polygon, j + 1)))
        continue;
      check.report(
          fmt::format("{}.vertex[{}]", field, j),
          fmt::format("the side from here meets the side from vertex[{}]; sides must not cross or touch", i));
      return;
    }
  }
}

// False when a corner is wrong in itself; its sides then meet others, which says nothing new.
bool check_corners(const Polygon& polygon, const std::string& field, FieldCheck& check) {
  const std::size_t before_all = check.problems().size();
  const int n = polygon.vertex_size();
  for (int i = 0; i < n; ++i) {
    const Point& before = vertex(polygon, i + n - 1);
    const Point& here = vertex(polygon, i);
    const Point& after = vertex(polygon, i + 1);
    const double turn = cross(before, here, after);
    const double ahead =
        (here.x() - before.x()) * (after.x() - here.x()) + (here.y() - before.y()) * (after.y() - here.y());
    const std::string corner = fmt::format("{}.vertex[{}]", field, i);
    if (here.x() == after.x() && here.y() == after.y())
      check.report(corner, fmt::format("equals the next, ({}, {}); remove one", here.x(), here.y()));
    else if (turn == 0 && ahead < 0)
      check.report(corner, "the sides double back on themselves; remove the vertex");
  }
  return check.problems().size() == before_all;
}

void check_formula(const std::string& formula, const std::string& field, FieldCheck& check) {
  if (formula.size() > kLongestFormula)
    return check.report(field, fmt::format("has {} characters, at most {} are supported; use fewer terms",
                                           formula.size(), kLongestFormula));
  try {
    const Formula parsed(formula);
  } catch (const FormulaError& error) {
    check.report(field, error.what());
  }
}

void check_field(const Field& given, const std::string& field, FieldCheck& check) {
  if (given.x().empty() && given.y().empty() && given.z().empty())
    check.report(field, "has no formula; give x, y or z, e.g. x: \"0.1*sin(pi*x)\"");
  if (check.dimension() == 2 && !given.z().empty())
    check.report(field + ".z", "does not exist in two dimensions; remove it");
  check_formula(given.x(), field + ".x", check);
  check_formula(given.y(), field + ".y", check);
  check_formula(given.z(), field + ".z", check);
}

void check_start(const FluidRegion& region, const std::string& field, FieldCheck& check) {
  check.optional_vector(region.velocity(), field + ".velocity", "the initial velocity");
  if (region.has_velocity_field()) {
    check_field(region.velocity_field(), field + ".velocity_field", check);
    if (!region.velocity().empty())
      check.report(field + ".velocity_field", "stands beside velocity; give one of them");
  }
  if (region.has_displacement()) check_field(region.displacement(), field + ".displacement", check);
  check_formula(region.pressure(), field + ".pressure", check);
  if (!region.pressure().empty() && region.hydrostatic())
    check.report(field + ".pressure", "stands beside hydrostatic: true; give one of them");
}

}  // namespace

void check_polygon(const Polygon& polygon, const std::string& field, FieldCheck& check) {
  const int n = polygon.vertex_size();
  if (check.dimension() != 2)
    return check.report(field, "polygons exist in two dimensions only; use a box or a ball");
  if (!check.count(n, kMostVertices, field + ".vertex")) return;
  if (n < 3) return check.report(field, fmt::format("has {} vertices; give at least 3", n));
  double twice_area = 0;
  for (int i = 0; i < n; ++i)
    twice_area += cross(polygon.vertex(0), vertex(polygon, i), vertex(polygon, i + 1));
  if (twice_area == 0) return check.report(field, "has no area; give vertices that are not all in line");
  if (twice_area < 0) return check.report(field, "runs clockwise; give the vertices counter-clockwise");
  if (check_corners(polygon, field, check)) check_crossings(polygon, field, check);
}

void check_fluid(const FluidRegion& region, const std::string& field, FieldCheck& check) {
  check_start(region, field, check);
  switch (region.shape_case()) {
    case FluidRegion::kBox: {
      const bool low = check.vector(region.box().min(), field + ".box.min", "the box's lower corner");
      const bool high = check.vector(region.box().max(), field + ".box.max", "the box's upper corner");
      for (int a = 0; low && high && a < check.dimension(); ++a) {
        if (region.box().max(a) <= region.box().min(a))
          check.report(fmt::format("{}.box.max[{}]", field, a),
                       fmt::format("{} m is not above the lower corner at {} m", region.box().max(a),
                                   region.box().min(a)));
      }
      return;
    }
    case FluidRegion::kBall:
      check.vector(region.ball().center(), field + ".ball.center", "the ball's centre");
      check.positive(region.ball().radius(), field + ".ball.radius", "m", "give the ball's radius");
      return;
    case FluidRegion::kPolygon:
      return check_polygon(region.polygon(), field + ".polygon", check);
    case FluidRegion::SHAPE_NOT_SET:
      check.report(field, "has no shape; give box, ball or polygon");
  }
}

}  // namespace sluice::protocol
