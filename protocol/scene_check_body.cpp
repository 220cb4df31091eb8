#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "protocol/field_check.hpp"

namespace sluice::protocol {
namespace {

constexpr int kMostBodies = 1000;
constexpr std::size_t kLongestName = 64;
constexpr double kUnitTolerance = 1e-6;

// Names become parts of HDF5 paths, where "/" and "." have a meaning.
bool usable_name(const std::string& name) {
  const auto allowed = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_' || c == '-'; };
  return !name.empty() && name.size() <= kLongestName && std::all_of(name.begin(), name.end(), allowed);
}

void check_name(const Body& body, const std::string& field, std::map<std::string, std::string>& seen,
                FieldCheck& check) {
  if (!usable_name(body.name()))
    check.report(field + ".name", fmt::format("\"{}\" is not 1 to {} letters, digits, _ or -; name the body",
                                              body.name(), kLongestName));
  else if (body.name() == "energy")
    check.report(field + ".name", "\"energy\" is the name of a record of every run; choose another");
  else if (const auto [first, fresh] = seen.emplace(body.name(), field); !fresh)
    check.report(field + ".name",
                 fmt::format("\"{}\" is the name of {} too; names must differ", body.name(), first->second));
}

void check_shape(const Body& body, const std::string& field, FieldCheck& check) {
  switch (body.shape_case()) {
    case Body::kBox:
      if (!check.vector(body.box().size(), field + ".box.size", "the box's edge lengths")) return;
      for (int a = 0; a < check.dimension(); ++a)
        check.positive(body.box().size(a), fmt::format("{}.box.size[{}]", field, a), "m",
                       "give the length of the edge");
      return;
    case Body::kBall:
      return check.positive(body.ball().radius(), field + ".ball.radius", "m", "give the ball's radius");
    case Body::kPolygon:
      return check_polygon(body.polygon(), true, field + ".polygon", check);
    case Body::SHAPE_NOT_SET:
      check.report(field, "has no shape; give box, ball or polygon");
  }
}

void check_mass(const Body& body, const std::string& field, FieldCheck& check) {
  if (body.has_density())
    check.positive(body.density(), field + ".density", "kg/m^3", "give the body's density, water is 1000");
  if (body.has_mass())
    check.positive(body.mass(), field + ".mass", check.dimension() == 2 ? "kg/m" : "kg",
                   "give the body's mass");
  if (body.has_density() && body.has_mass())
    check.report(field + ".mass", "density is given too; leave one of them out");
  if (!body.has_density() && !body.has_mass() && !body.has_prescribed())
    check.report(field, "is free and has neither density nor mass; give one, or a prescribed motion");
}

void check_orientation(const Body& body, const std::string& field, FieldCheck& check) {
  if (check.dimension() == 3 && body.angle() != 0)
    check.report(field + ".angle", "is for two dimensions; give orientation, a unit quaternion w x y z");
  const Vector& q = body.orientation();
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

void check_initial_motion(const Body& body, const std::string& field, FieldCheck& check) {
  check.optional_vector(body.velocity(), field + ".velocity", "the initial velocity");
  check.optional_rotation(body.angular_velocity(), field + ".angular_velocity",
                          "the initial angular velocity");
  if (!body.has_prescribed()) return;
  for (const auto& [name, given] : {std::pair{".velocity", !body.velocity().empty()},
                                    std::pair{".angular_velocity", !body.angular_velocity().empty()}}) {
    if (given)
      check.report(field + name, "is for free bodies; the motion of this one is prescribed, remove it");
  }
}

}  // namespace

void check_bodies(const Scene& scene, FieldCheck& check) {
  if (!check.count(scene.body_size(), kMostBodies, "body")) return;
  std::map<std::string, std::string> names;
  for (int i = 0; i < scene.body_size(); ++i) {
    const Body& body = scene.body(i);
    const std::string field = fmt::format("body[{}]", i);
    check_name(body, field, names, check);
    check_shape(body, field, check);
    check_mass(body, field, check);
    check.vector(body.position(), field + ".position", "the position of the centre of mass");
    check_orientation(body, field, check);
    check_initial_motion(body, field, check);
    if (body.has_prescribed()) check_motion(body.prescribed(), field + ".prescribed", check);
  }
}

}  // namespace sluice::protocol
