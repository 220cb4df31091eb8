#include <fmt/format.h>

#include <cmath>

#include "protocol/field_check.hpp"
#include "protocol/mesh_file.hpp"

namespace sluice::protocol {
namespace {

constexpr int kMostParts = 1000;
constexpr double kUnitTolerance = 1e-6;

bool in_space(const std::string& field, FieldCheck& check) {
  if (check.dimension() == 3) return true;
  check.report(field, "is for three dimensions; in two give box, ball, polygon or compound");
  return false;
}

void check_shape(const Cuboid& box, const std::string& field, FieldCheck& check) {
  if (!check.vector(box.size(), field + ".size", "the box's edge lengths")) return;
  for (int a = 0; a < check.dimension(); ++a)
    check.positive(box.size(a), fmt::format("{}.size[{}]", field, a), "m", "give the length of the edge");
}

void check_shape(const Round& ball, const std::string& field, FieldCheck& check) {
  check.positive(ball.radius(), field + ".radius", "m", "give the ball's radius");
}

void check_shape(const Polygon& polygon, const std::string& field, FieldCheck& check) {
  check_polygon(polygon, field, check);
}

void check_shape(const Cylinder& cylinder, const std::string& field, FieldCheck& check) {
  if (!in_space(field, check)) return;
  check.positive(cylinder.radius(), field + ".radius", "m", "give the cylinder's radius");
  check.positive(cylinder.length(), field + ".length", "m", "give the cylinder's length");
}

// A file that could not be read has been reported.
void check_shape(const Mesh& mesh, const std::string& field, FieldCheck& check) {
  if (!in_space(field, check) || !mesh.file().empty()) return;
  if (mesh.has_scale()) check.positive(mesh.scale(), field + ".scale", "m", "leave it out for metres");
  if (mesh.vertex().empty()) return check.report(field, "has neither file nor vertices; give one");
  if (const std::string problem = check_surface(mesh); !problem.empty()) check.report(field, problem);
}

template <typename WithShape>
bool check_simple(const WithShape& body, const std::string& field, FieldCheck& check) {
  if (body.has_box()) return check_shape(body.box(), field + ".box", check), true;
  if (body.has_ball()) return check_shape(body.ball(), field + ".ball", check), true;
  if (body.has_polygon()) return check_shape(body.polygon(), field + ".polygon", check), true;
  if (body.has_cylinder()) return check_shape(body.cylinder(), field + ".cylinder", check), true;
  if (body.has_mesh()) return check_shape(body.mesh(), field + ".mesh", check), true;
  return false;
}

void check_part(const Part& part, const std::string& field, FieldCheck& check) {
  if (!check_simple(part, field, check))
    check.report(field, "has no shape; give box, ball, polygon, cylinder or mesh");
  check.optional_vector(part.position(), field + ".position", "the part's position");
  check_turn(part.angle(), part.orientation(), field, check);
  if (part.has_density())
    check.positive(part.density(), field + ".density", "kg/m^3", "leave it out for the body's");
}

}  // namespace

void check_turn(double angle, const Vector& q, const std::string& field, FieldCheck& check) {
  if (check.dimension() == 3 && angle != 0)
    check.report(field + ".angle", "is for two dimensions; give orientation, a unit quaternion w x y z");
  if (q.empty()) return;
  const std::string path = field + ".orientation";
  if (check.dimension() == 2) return check.report(path, "is for three dimensions; give angle [rad]");
  if (q.size() != 4)
    return check.report(path, fmt::format("{} entries; a quaternion w x y z has 4", q.size()));
  const double norm = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  if (std::abs(norm - 1) > kUnitTolerance)
    check.report(path, fmt::format("has length {}; a rotation is a quaternion of length 1 within {}", norm,
                                   kUnitTolerance));
}

void check_body_shape(const Body& body, const std::string& field, FieldCheck& check) {
  if (check_simple(body, field, check)) return;
  if (!body.has_compound())
    return check.report(field, "has no shape; give box, ball, polygon, cylinder, mesh or compound");
  const Compound& compound = body.compound();
  if (compound.part().empty()) check.report(field + ".compound", "has no part; give at least one");
  if (!check.count(compound.part_size(), kMostParts, field + ".compound.part")) return;
  for (int p = 0; p < compound.part_size(); ++p)
    check_part(compound.part(p), fmt::format("{}.compound.part[{}]", field, p), check);
  for (int p = 0; p < compound.part_size(); ++p)
    if (compound.part(p).has_density() && !body.has_density())
      return check.report(fmt::format("{}.compound.part[{}].density", field, p),
                          "needs the body's density, which parts without one have; give that too");
}

}  // namespace sluice::protocol
