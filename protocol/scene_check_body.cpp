#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "protocol/body_kind.hpp"
#include "protocol/field_check.hpp"

namespace sluice::protocol {
namespace {

constexpr int kMostBodies = 1000;
constexpr std::size_t kLongestName = 64;

// Whether the matrix is positive definite.
bool is_possible(const Vector& inertia) {
  if (inertia.size() < 6) return true;
  const double xx = inertia[0], yy = inertia[1], zz = inertia[2], xy = inertia[3], xz = inertia[4],
               yz = inertia[5];
  return xx * yy > xy * xy &&
         xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * xz) + xz * (xy * yz - yy * xz) > 0;
}

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

void check_owner(const Body& body, const std::string& field, FieldCheck& check) {
  if (!body.owner().empty() && !usable_name(body.owner()))
    check.report(field + ".owner",
                 fmt::format("\"{}\" is not 1 to {} letters, digits, _ or -; choose such a name",
                             body.owner(), kLongestName));
}

void check_mass(const Body& body, const std::string& field, FieldCheck& check) {
  if (body.has_density())
    check.positive(body.density(), field + ".density", "kg/m^3", "give the body's density, water is 1000");
  if (body.has_mass())
    check.positive(body.mass(), field + ".mass", check.dimension() == 2 ? "kg/m" : "kg",
                   "give the body's mass");
  if (body.has_density() && body.has_mass())
    check.report(field + ".mass", "density is given too; leave one of them out");
  if (body.has_density() || body.has_mass() || !is_ever_free(body)) return;
  if (body.has_prescribed())
    check.report(field + (is_partly_free(body) ? "" : ".prescribed.release"),
                 "makes the body free, which has neither density nor mass; give one");
  else
    check.report(field, "is free and has neither density nor mass; give one, or a prescribed motion");
}

void check_inertia(const Body& body, const std::string& field, FieldCheck& check) {
  check.optional_vector(body.center_of_mass(), field + ".center_of_mass", "the centre of mass");
  const Vector& inertia = body.inertia();
  if (inertia.empty()) return;
  const std::string path = field + ".inertia";
  const bool fits = check.dimension() == 2 ? inertia.size() == 1 : inertia.size() == 3 || inertia.size() == 6;
  if (!fits)
    return check.report(
        path, fmt::format("{} entries; give {}", inertia.size(),
                          check.dimension() == 2 ? "one, about z" : "xx, yy, zz, or those and xy, xz, yz"));
  for (int i = 0; i < std::min(inertia.size(), 3); ++i)
    check.positive(inertia[i], fmt::format("{}[{}]", path, i), "kg m^2", "give the moment of inertia");
  if (!is_possible(inertia))
    check.report(path, "belongs to no body: its determinant or a principal minor is not positive");
}

// Of a body with a prescribed motion: only along axes that are free all the same. `first` is the axis of
// entry 0.
void check_not_prescribed(const Vector& velocity, const google::protobuf::RepeatedField<int>& free, int first,
                          const std::string& path, FieldCheck& check) {
  if (free.empty() && !velocity.empty())
    return check.report(path, "is for free bodies; the motion of this one is prescribed, remove it");
  for (int i = 0; i < velocity.size(); ++i)
    if (velocity[i] != 0 && std::find(free.begin(), free.end(), X_AXIS + first + i) == free.end())
      check.report(fmt::format("{}[{}]", path, i), "is along an axis that the motion prescribes; give 0");
}

void check_initial_motion(const Body& body, const std::string& field, FieldCheck& check) {
  check.optional_vector(body.velocity(), field + ".velocity", "the initial velocity");
  check.optional_rotation(body.angular_velocity(), field + ".angular_velocity",
                          "the initial angular velocity");
  if (!body.has_prescribed()) return;
  check_not_prescribed(body.velocity(), body.free(), 0, field + ".velocity", check);
  const int first_turn = check.dimension() == 2 ? 2 : 0;
  check_not_prescribed(body.angular_velocity(), body.free_rotation(), first_turn, field + ".angular_velocity",
                       check);
}

}  // namespace

void check_bodies(const Scene& scene, FieldCheck& check) {
  if (!check.count(scene.body_size(), kMostBodies, "body")) return;
  std::map<std::string, std::string> names;
  for (int i = 0; i < scene.body_size(); ++i) {
    const Body& body = scene.body(i);
    const std::string field = fmt::format("body[{}]", i);
    check_name(body, field, names, check);
    check_owner(body, field, check);
    check_body_shape(body, field, check);
    check_mass(body, field, check);
    check.vector(body.position(), field + ".position", "the position of the centre of mass");
    check_turn(body.angle(), body.orientation(), field, check);
    check_inertia(body, field, check);
    check_contact(body.contact(), field + ".contact", check);
    check_initial_motion(body, field, check);
    check_axes(body, field, check);
    if (body.has_prescribed()) check_motion(body.prescribed(), field + ".prescribed", check);
  }
}

}  // namespace sluice::protocol
