#include "protocol/mass_properties.hpp"

#include <Eigen/Geometry>
#include <numbers>

namespace sluice::protocol {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// Products of inertia below this share of the trace are round-off.
constexpr double kRoundOff = 1e-12;

template <typename Entries>
Vector3d vector_of(const Entries& entries) {
  Vector3d v = Vector3d::Zero();
  for (int i = 0; i < std::min(entries.size(), 3); ++i) v[i] = entries[i];
  return v;
}

Moments of(const Cuboid& box, int dimension) {
  const Vector3d size = vector_of(box.size());
  const double volume = dimension == 2 ? size.x() * size.y() : size.prod();
  return {volume, Vector3d::Zero(), (volume / 12 * size.cwiseAbs2()).asDiagonal()};
}

Moments of(const Round& ball, int dimension) {
  const double r2 = ball.radius() * ball.radius(), disc = std::numbers::pi * r2;
  if (dimension == 2) return {disc, Vector3d::Zero(), (disc * r2 / 4 * Vector3d(1, 1, 0)).asDiagonal()};
  const double volume = 4.0 / 3 * disc * ball.radius();
  return {volume, Vector3d::Zero(), Matrix3d::Identity() * (volume * r2 / 5)};
}

Moments of(const Cylinder& cylinder, int) {
  const double r2 = cylinder.radius() * cylinder.radius(), l = cylinder.length();
  const double volume = std::numbers::pi * r2 * l;
  Vector3d second = Vector3d::Constant(volume * r2 / 4);
  second[cylinder.axis() == AXIS_UNSPECIFIED ? 2 : cylinder.axis() - X_AXIS] = volume * l * l / 12;
  return {volume, Vector3d::Zero(), second.asDiagonal()};
}

// x -> R x + t
Moments moved(const Moments& m, const Matrix3d& R, const Vector3d& t) {
  const Vector3d first = R * m.first;
  return {m.volume, first + m.volume * t,
          R * m.second * R.transpose() + first * t.transpose() + t * first.transpose() +
              m.volume * t * t.transpose()};
}

// Sum over the triangles from the first vertex, which keeps digits far from the origin, to each side.
Moments of(const Polygon& polygon, int) {
  Moments sum;
  const int n = polygon.vertex_size();
  if (n == 0) return sum;
  const Vector3d origin(polygon.vertex(0).x(), polygon.vertex(0).y(), 0);
  for (int i = 0; i < n; ++i) {
    const Vector3d a = Vector3d(polygon.vertex(i).x(), polygon.vertex(i).y(), 0) - origin;
    const Vector3d b = Vector3d(polygon.vertex((i + 1) % n).x(), polygon.vertex((i + 1) % n).y(), 0) - origin;
    const double area = a.cross(b).z() / 2;
    sum.volume += area;
    sum.first += area / 3 * (a + b);
    sum.second += area / 12 * ((a + b) * (a + b).transpose() + a * a.transpose() + b * b.transpose());
  }
  return moved(sum, Matrix3d::Identity(), origin);
}

// Sum over the tetrahedra from the first vertex to each triangle.
Moments of(const Mesh& mesh, int) {
  Moments sum;
  if (mesh.vertex_size() < 3) return sum;
  const Vector3d origin(mesh.vertex(0), mesh.vertex(1), mesh.vertex(2));
  const auto vertex = [&](int corner) {
    const int first = 3 * static_cast<int>(mesh.triangle(corner));
    return Vector3d(Vector3d(mesh.vertex(first), mesh.vertex(first + 1), mesh.vertex(first + 2)) - origin);
  };
  for (int t = 0; t + 2 < mesh.triangle_size(); t += 3) {
    const Vector3d a = vertex(t), b = vertex(t + 1), c = vertex(t + 2), s = a + b + c;
    const double volume = a.dot(b.cross(c)) / 6;
    sum.volume += volume;
    sum.first += volume / 4 * s;
    sum.second +=
        volume / 20 * (s * s.transpose() + a * a.transpose() + b * b.transpose() + c * c.transpose());
  }
  return moved(sum, Matrix3d::Identity(), origin);
}

template <typename WithShape>
Moments of_simple(const WithShape& body, int dimension) {
  if (body.has_box()) return of(body.box(), dimension);
  if (body.has_ball()) return of(body.ball(), dimension);
  if (body.has_polygon()) return of(body.polygon(), dimension);
  if (body.has_cylinder()) return of(body.cylinder(), dimension);
  if (body.has_mesh()) return of(body.mesh(), dimension);
  return {};
}

Matrix3d orientation(const Part& part, int dimension) {
  if (dimension == 2) return Eigen::AngleAxisd(part.angle(), Vector3d::UnitZ()).toRotationMatrix();
  const auto& q = part.orientation();
  if (q.size() != 4) return Matrix3d::Identity();
  return Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized().toRotationMatrix();
}

Matrix3d given_inertia(const Body& body, int dimension) {
  const auto& entries = body.inertia();
  if (dimension == 2) return Vector3d(0, 0, entries[0]).asDiagonal();
  Matrix3d inertia = Vector3d(entries[0], entries[1], entries[2]).asDiagonal();
  if (entries.size() < 6) return inertia;
  inertia(0, 1) = inertia(1, 0) = entries[3];
  inertia(0, 2) = inertia(2, 0) = entries[4];
  inertia(1, 2) = inertia(2, 1) = entries[5];
  return inertia;
}

Matrix3d homogeneous_inertia(const Moments& m, const Vector3d& center, int dimension) {
  const Matrix3d second = moved(m, Matrix3d::Identity(), -center).second;
  Matrix3d inertia = second.trace() * Matrix3d::Identity() - second;
  if (dimension == 2) return Vector3d(0, 0, inertia(2, 2)).asDiagonal();
  return (inertia.array().abs() > kRoundOff * inertia.trace()).select(inertia, Matrix3d::Zero());
}

}  // namespace

Moments moments(const Body& body, int dimension) {
  if (!body.has_compound()) return of_simple(body, dimension);
  Moments sum;
  for (const Part& part : body.compound().part()) {
    const double share = part.has_density() && body.density() > 0 ? part.density() / body.density() : 1;
    const Moments m =
        moved(of_simple(part, dimension), orientation(part, dimension), vector_of(part.position()));
    sum.volume += share * m.volume;
    sum.first += share * m.first;
    sum.second += share * m.second;
  }
  return sum;
}

MassProperties mass_properties(const Body& body, int dimension) {
  const Moments m = moments(body, dimension);
  MassProperties result;
  result.mass = body.has_mass() ? body.mass() : body.density() * m.volume;
  if (!body.center_of_mass().empty())
    result.center = vector_of(body.center_of_mass());
  else if (m.volume > 0)
    result.center = m.first / m.volume;
  if (!body.inertia().empty())
    result.inertia = given_inertia(body, dimension);
  else if (m.volume > 0)
    result.inertia = result.mass / m.volume * homogeneous_inertia(m, result.center, dimension);
  return result;
}

}  // namespace sluice::protocol
