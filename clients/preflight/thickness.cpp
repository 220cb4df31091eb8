#include "clients/preflight/thickness.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "clients/rigid/convert.hpp"
#include "rigid/polygon.hpp"
#include "rigid/shape.hpp"

namespace sluice::clients {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kMostTriangles = 2000;  // that are started from: in between, a mesh is hardly thinner

rigid::Vertices outline_of(const Polygon& polygon) {
  rigid::Vertices vertices;
  for (const Point& vertex : polygon.vertex()) vertices.emplace_back(vertex.x(), vertex.y());
  return vertices;
}

double cross(const Vector2d& a, const Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

// From x along the unit vector d to the segment from a to b; infinite where it is missed.
double way_to_edge(const Vector2d& x, const Vector2d& d, const Vector2d& a, const Vector2d& b) {
  const Vector2d edge = b - a;
  const double across = cross(d, edge);
  if (across == 0) return kInfinity;
  const double way = cross(a - x, edge) / across, share = cross(a - x, d) / across;
  return way > 0 && share >= 0 && share <= 1 ? way : kInfinity;
}

double through(const rigid::Vertices& outline) {
  double least = kInfinity;
  const std::size_t n = outline.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vector2d a = outline[i], edge = outline[(i + 1) % n] - a;
    const Vector2d inward = Vector2d(-edge.y(), edge.x()).normalized();
    for (const double share : {0.1, 0.3, 0.5, 0.7, 0.9})
      for (std::size_t k = 0; k < n; ++k)
        if (k != i)
          least = std::min(least, way_to_edge(a + share * edge, inward, outline[k], outline[(k + 1) % n]));
  }
  return least;
}

using Triangle = std::array<Vector3d, 3>;

// T. Moeller, B. Trumbore, J. Graphics Tools 2, 1997.
double way_to_triangle(const Vector3d& x, const Vector3d& d, const Triangle& t) {
  const Vector3d e1 = t[1] - t[0], e2 = t[2] - t[0], p = d.cross(e2), s = x - t[0], q = s.cross(e1);
  const double det = e1.dot(p);
  if (det == 0) return kInfinity;
  const double u = s.dot(p) / det, v = d.dot(q) / det, way = e2.dot(q) / det;
  return way > 0 && u >= 0 && v >= 0 && u + v <= 1 ? way : kInfinity;
}

double through(const Mesh& mesh) {
  const auto corner = [&](int i) {
    const int v = 3 * static_cast<int>(mesh.triangle(i));
    return Vector3d(mesh.vertex(v), mesh.vertex(v + 1), mesh.vertex(v + 2));
  };
  std::vector<Triangle> triangles;
  for (int t = 0; t + 2 < mesh.triangle_size(); t += 3)
    triangles.push_back({corner(t), corner(t + 1), corner(t + 2)});
  double least = kInfinity;
  const std::size_t stride = triangles.size() / kMostTriangles + 1;
  for (std::size_t i = 0; i < triangles.size(); i += stride) {
    const Triangle& t = triangles[i];
    const Vector3d middle = (t[0] + t[1] + t[2]) / 3, inward = -(t[1] - t[0]).cross(t[2] - t[0]).normalized();
    for (std::size_t k = 0; k < triangles.size(); ++k)
      if (k != i) least = std::min(least, way_to_triangle(middle, inward, triangles[k]));
  }
  return least;
}

template <typename WithShape>
double thickness_of(const WithShape& body, int dimension) {
  if (body.has_box()) return rigid::thickness(rigid::Box{to_vector(body.box().size()) / 2}, dimension);
  if (body.has_ball()) return 2 * body.ball().radius();
  if (body.has_cylinder()) return std::min(2 * body.cylinder().radius(), body.cylinder().length());
  if (body.has_mesh()) return through(body.mesh());
  if (!body.has_polygon()) return kInfinity;
  const rigid::Vertices outline = outline_of(body.polygon());
  return rigid::is_convex(outline) ? rigid::thickness(rigid::centred_polygon(outline), dimension)
                                   : through(outline);
}

template <typename WithShape>
bool has_plate_rule(const WithShape& body) {
  return body.has_box() || (body.has_polygon() && rigid::is_convex(outline_of(body.polygon())));
}

// The least of a body's parts, or of the body.
template <typename Thickness>
double least(const Body& body, const Thickness& thickness) {
  if (!body.has_compound()) return thickness(body);
  double smallest = kInfinity;
  for (const Part& part : body.compound().part()) smallest = std::min(smallest, thickness(part));
  return smallest;
}

}  // namespace

double least_thickness(const Body& body, int dimension) {
  return least(body, [&](const auto& shape) { return thickness_of(shape, dimension); });
}

double least_without_plate_rule(const Body& body, int dimension) {
  return least(body, [&](const auto& shape) {
    return has_plate_rule(shape) ? kInfinity : thickness_of(shape, dimension);
  });
}

}  // namespace sluice::clients
