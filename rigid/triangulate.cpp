#include "rigid/triangulate.hpp"

#include <algorithm>

namespace sluice::rigid {
namespace {

// Twice the area of a, b, c; positive when they turn left.
double turn(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  return cross(b - a, c - a);
}

Vertices corner(const Vertices& v, std::size_t i) {
  return {v[(i + v.size() - 1) % v.size()], v[i], v[(i + 1) % v.size()]};
}

bool holds(const Vertices& triangle, const Eigen::Vector2d& x) {
  return turn(triangle[0], triangle[1], x) >= 0 && turn(triangle[1], triangle[2], x) >= 0 &&
         turn(triangle[2], triangle[0], x) >= 0;
}

bool is_ear(const Vertices& v, std::size_t i) {
  const Vertices triangle = corner(v, i);
  if (turn(triangle[0], triangle[1], triangle[2]) <= 0) return false;
  return std::none_of(v.begin(), v.end(), [&](const Eigen::Vector2d& x) {
    const bool is_corner = std::find(triangle.begin(), triangle.end(), x) != triangle.end();
    return !is_corner && holds(triangle, x);
  });
}

// The next vertex to cut off: an ear, or one on a straight side, which leaves no triangle.
std::size_t next_cut(const Vertices& v) {
  for (std::size_t i = 0; i < v.size(); ++i) {
    const Vertices c = corner(v, i);
    if (is_ear(v, i) || turn(c[0], c[1], c[2]) == 0) return i;
  }
  return 0;  // only round-off brings us here: the rest is a sliver
}

}  // namespace

std::vector<Vertices> triangulate(Vertices vertices) {
  std::vector<Vertices> triangles;
  while (vertices.size() >= 3) {
    const std::size_t cut = next_cut(vertices);
    const Vertices triangle = corner(vertices, cut);
    if (turn(triangle[0], triangle[1], triangle[2]) > 0) triangles.push_back(triangle);
    vertices.erase(vertices.begin() + static_cast<std::ptrdiff_t>(cut));
  }
  return triangles;
}

}  // namespace sluice::rigid
