#include <algorithm>
#include <cmath>

#include "fluid/layers.hpp"

namespace sluice::fluid {

namespace {

using Eigen::Vector2d;

class Outline {
 public:
  Outline(const PolygonShape& polygon, double spacing, int layers)
      : polygon_(polygon), vertex_(polygon.vertices), spacing_(spacing), layers_(layers) {}

  Boundary run() {
    for (std::size_t k = 0; k < vertex_.size(); ++k) {
      add_edge(k);
      add_corner(k);
    }
    return std::move(body_);
  }

 private:
  [[nodiscard]] Vector2d edge(std::size_t k) const {
    return vertex_[(k + 1) % vertex_.size()] - vertex_[k % vertex_.size()];
  }
  [[nodiscard]] Vector2d inward(std::size_t k) const {
    const Vector2d t = edge(k).normalized();
    return {-t.y(), t.x()};
  }

  void add_edge(std::size_t k) {
    const double length = edge(k).norm();
    const int count = std::max(1, static_cast<int>(std::lround(length / spacing_)));
    for (int l = 0; l < layers_; ++l)
      for (int i = 0; i < count; ++i)
        add(vertex_[k] + (i + 0.5) / count * edge(k), inward(k), l, length / count * spacing_);
  }

  // The arcs between the inward normals of the edges before and after a corner that points inward.
  void add_corner(std::size_t k) {
    const std::size_t before = k + vertex_.size() - 1;
    const Vector2d in = edge(before), out = edge(k), normal = inward(before);
    const double turn = std::atan2(in.x() * out.y() - in.y() * out.x(), in.dot(out));
    if (turn >= 0) return;
    for (int l = 0; l < layers_; ++l) {
      const double depth = (l + 0.5) * spacing_;
      const int count = std::max(1, static_cast<int>(std::lround(-turn * depth / spacing_)));
      for (int i = 0; i < count; ++i) {
        const Eigen::Rotation2Dd rotation(turn * (i + 0.5) / count);
        add(vertex_[k], rotation * normal, l, -turn * depth * spacing_ / count);
      }
    }
  }

  // The point of layer l below a point of the surface, unless another part of the outline is nearer.
  void add(const Vector2d& surface, const Vector2d& normal, int l, double volume) {
    const double depth = (l + 0.5) * spacing_;
    const Vector2d x = surface + depth * normal;
    const Eigen::Vector3d position(x.x(), x.y(), 0);
    if (signed_distance(polygon_, position, 2) > -depth + 1e-9 * spacing_ || is_taken(position)) return;
    body_.position.push_back(position);
    body_.volume.push_back(volume);
    body_.to_surface.emplace_back(surface.x() - x.x(), surface.y() - x.y(), 0);
  }

  // By an edge as near, where layers meet on a mitre.
  [[nodiscard]] bool is_taken(const Eigen::Vector3d& x) const {
    return std::any_of(body_.position.begin(), body_.position.end(),
                       [&](const Eigen::Vector3d& y) { return (x - y).norm() < 0.1 * spacing_; });
  }

  const PolygonShape& polygon_;
  const std::vector<Vector2d>& vertex_;
  double spacing_;
  int layers_;
  Boundary body_;
};

}  // namespace

Boundary sample_outline(const PolygonShape& polygon, double spacing, int layers) {
  return Outline(polygon, spacing, layers).run();
}

}  // namespace sluice::fluid
