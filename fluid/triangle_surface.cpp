#include "fluid/triangle_surface.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <map>
#include <unsupported/Eigen/BVH>

namespace sluice::fluid {

namespace {

using Eigen::Vector3d;

// The nearest point of a triangle and what it lies on: 0-2 a corner, 3-5 the side after that corner, 6 the
// face. C. Ericson, Real-Time Collision Detection (2005), section 5.1.5.
struct OnTriangle {
  Vector3d point;
  int feature;
};

OnTriangle nearest_on(const Vector3d& p, const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const Vector3d ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap), d3 = ab.dot(bp), d4 = ac.dot(bp), d5 = ab.dot(cp),
               d6 = ac.dot(cp);
  if (d1 <= 0 && d2 <= 0) return {a, 0};
  if (d3 >= 0 && d4 <= d3) return {b, 1};
  if (d6 >= 0 && d5 <= d6) return {c, 2};
  const double vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return {a + d1 / (d1 - d3) * ab, 3};
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) return {b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b), 4};
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return {a + d2 / (d2 - d6) * ac, 5};
  return {a + (vb * ab + vc * ac) / (va + vb + vc), 6};
}

double angle_between(const Vector3d& u, const Vector3d& v) {
  return std::atan2(u.cross(v).norm(), u.dot(v));
}

}  // namespace

struct TriangleSurface::Tree {
  Eigen::KdBVH<double, 3, int> boxes;
};

TriangleSurface::TriangleSurface(std::vector<Vector3d> vertices, std::vector<Triangle> triangles)
    : vertices_(std::move(vertices)), triangles_(std::move(triangles)), tree_(std::make_unique<Tree>()) {
  std::vector<Vector3d> at_vertex(vertices_.size(), Vector3d::Zero());
  std::map<std::pair<std::uint32_t, std::uint32_t>, Vector3d> at_edge;
  std::vector<Eigen::AlignedBox3d> boxes;
  std::vector<int> numbers;
  normals_.resize(triangles_.size());
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    Eigen::AlignedBox3d box;
    const Triangle& corner = triangles_[t];
    const Vector3d &a = vertices_[corner[0]], &b = vertices_[corner[1]], &c = vertices_[corner[2]];
    const Vector3d normal = (b - a).cross(c - a).normalized();
    normals_[t].face = normal;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector3d &x = vertices_[corner[k]], &after = vertices_[corner[(k + 1) % 3]],
                     &before = vertices_[corner[(k + 2) % 3]];
      at_vertex[corner[k]] += angle_between(after - x, before - x) * normal;
      at_edge.try_emplace(std::minmax(corner[k], corner[(k + 1) % 3]), Vector3d::Zero()).first->second +=
          normal;
      box.extend(x);
    }
    boxes.push_back(box);
    numbers.push_back(static_cast<int>(t));
  }
  for (std::size_t t = 0; t < triangles_.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const Triangle& corner = triangles_[t];
      normals_[t].corner[k] = at_vertex[corner[k]];
      normals_[t].side[k] = at_edge.at(std::minmax(corner[k], corner[(k + 1) % 3]));
    }
  tree_->boxes.init(numbers.begin(), numbers.end(), boxes.begin(), boxes.end());
}

TriangleSurface::~TriangleSurface() = default;

double TriangleSurface::volume() const {
  double six = 0;
  for (const auto& [a, b, c] : triangles_) six += vertices_[a].dot(vertices_[b].cross(vertices_[c]));
  return six / 6;
}

TriangleSurface::Nearest TriangleSurface::nearest(const Vector3d& x) const {
  // The minimizer that Eigen's tree asks for.
  struct Search {
    using Scalar = double;
    const TriangleSurface& surface;
    const Vector3d& x;
    double least = std::numeric_limits<double>::infinity();
    OnTriangle found{Vector3d::Zero(), 0};
    std::size_t triangle = 0;

    double minimumOnVolume(const Eigen::AlignedBox3d& box) { return box.squaredExteriorDistance(x); }
    double minimumOnObject(int t) {
      const Triangle& corner = surface.triangles_[static_cast<std::size_t>(t)];
      const OnTriangle here = nearest_on(x, surface.vertices_[corner[0]], surface.vertices_[corner[1]],
                                         surface.vertices_[corner[2]]);
      const double distance = (x - here.point).squaredNorm();
      if (distance < least) {
        least = distance;
        found = here;
        triangle = static_cast<std::size_t>(t);
      }
      return distance;
    }
  } search{*this, x};
  Eigen::BVMinimize(tree_->boxes, search);
  const Normals& normals = normals_[search.triangle];
  const auto feature = static_cast<std::size_t>(search.found.feature);
  const Vector3d& normal = feature == 6  ? normals.face
                           : feature < 3 ? normals.corner[feature]
                                         : normals.side[feature - 3];
  const double distance = std::sqrt(search.least);
  return {search.found.point, (x - search.found.point).dot(normal) < 0 ? -distance : distance};
}

}  // namespace sluice::fluid
