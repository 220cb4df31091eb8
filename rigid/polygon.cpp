#include "rigid/polygon.hpp"

namespace sluice::rigid {
namespace {

template <typename Edge>
void for_each_edge(const Vertices& vertices, Edge&& edge) {
  for (std::size_t i = 0; i < vertices.size(); ++i) edge(vertices[i], vertices[(i + 1) % vertices.size()]);
}

}  // namespace

double area(const Vertices& vertices) {
  double sum = 0;
  for_each_edge(vertices, [&](const auto& a, const auto& b) { sum += cross(a, b); });
  return sum / 2;
}

Eigen::Vector2d centroid(const Vertices& vertices) {
  // About the first vertex, so that a polygon far from the origin loses no digits.
  const Eigen::Vector2d origin = vertices.front();
  Eigen::Vector2d moment = Eigen::Vector2d::Zero();
  double twice_area = 0;
  for_each_edge(vertices, [&](const Eigen::Vector2d& p, const Eigen::Vector2d& q) {
    const Eigen::Vector2d a = p - origin, b = q - origin;
    moment += cross(a, b) * (a + b);
    twice_area += cross(a, b);
  });
  return origin + moment / (3 * twice_area);
}

bool is_convex(const Vertices& vertices) {
  const std::size_t n = vertices.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Eigen::Vector2d in = vertices[i] - vertices[(i + n - 1) % n],
                          out = vertices[(i + 1) % n] - vertices[i];
    if (cross(in, out) < -1e-12 * in.norm() * out.norm()) return false;
  }
  return true;
}

double polar_moment(const Vertices& vertices) {
  double sum = 0;
  for_each_edge(vertices, [&](const auto& a, const auto& b) {
    sum += cross(a, b) * (a.squaredNorm() + a.dot(b) + b.squaredNorm());
  });
  return sum / 12;
}

}  // namespace sluice::rigid
