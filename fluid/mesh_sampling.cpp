#include <array>
#include <cmath>
#include <map>

#include "fluid/layers.hpp"

namespace sluice::fluid {

namespace {

using Eigen::Vector3d;

constexpr int kSpreading = 40;      // sweeps that push the points of a layer apart
constexpr double kReach = 1.6;      // of a push, in spacings: the nearest neighbours of an even spread
constexpr double kPush = 0.15;      // of a sweep, in spacings at touching
constexpr int kProjections = 8;     // on a surface of equal depth
constexpr double kOffDepth = 0.25;  // spacings off its depth beyond which a point has no place there
constexpr int kCounting = 3;        // points per spacing and axis that measure a layer's volume

class Layer {
 public:
  Layer(const TriangleSurface& surface, double spacing, int number)
      : surface_(surface), spacing_(spacing), depth_((number + 0.5) * spacing) {}

  [[nodiscard]] bool holds(double signed_distance) const {
    return std::abs(signed_distance + depth_) <= spacing_ / 2;
  }
  void seed(const Vector3d& x) { points_.push_back(x); }
  void count() { ++counted_; }

  void add_to(Boundary& body) {
    if (points_.empty()) return;
    for (Vector3d& x : points_) project(x);
    for (int i = 0; i < kSpreading; ++i) spread();
    const double cell = spacing_ / kCounting;
    const double volume = counted_ * cell * cell * cell / static_cast<double>(points_.size());
    for (const Vector3d& x : points_) {
      body.position.push_back(x);
      body.volume.push_back(volume);
      body.to_surface.push_back(surface_.nearest(x).point - x);
    }
  }

 private:
  using Cell = std::array<int, 3>;

  // To the layer's depth; where the body is not that deep the point stays.
  void project(Vector3d& x) const {
    Vector3d y = x;
    for (int i = 0; i < kProjections; ++i) {
      const auto nearest = surface_.nearest(y);
      const double off = nearest.signed_distance + depth_;
      if (std::abs(off) < 1e-6 * spacing_) break;
      if (nearest.signed_distance == 0) break;
      y -= off * (y - nearest.point) / nearest.signed_distance;  // along the gradient of the distance
    }
    if (std::abs(surface_.nearest(y).signed_distance + depth_) < kOffDepth * spacing_) x = y;
  }

  [[nodiscard]] Cell cell_of(const Vector3d& x) const {
    const double width = kReach * spacing_;
    return {static_cast<int>(std::floor(x.x() / width)), static_cast<int>(std::floor(x.y() / width)),
            static_cast<int>(std::floor(x.z() / width))};
  }

  void spread() {
    std::map<Cell, std::vector<std::size_t>> cells;
    for (std::size_t k = 0; k < points_.size(); ++k) cells[cell_of(points_[k])].push_back(k);
    const std::vector<Vector3d> before = points_;
    for (std::size_t k = 0; k < points_.size(); ++k) {
      points_[k] += push_on(k, before, cells);
      project(points_[k]);
    }
  }

  [[nodiscard]] Vector3d push_on(std::size_t k, const std::vector<Vector3d>& x,
                                 const std::map<Cell, std::vector<std::size_t>>& cells) const {
    const double reach = kReach * spacing_;
    const Cell home = cell_of(x[k]);
    Vector3d push = Vector3d::Zero();
    for (int n = 0; n < 27; ++n) {
      const auto cell = cells.find({home[0] + n % 3 - 1, home[1] + n / 3 % 3 - 1, home[2] + n / 9 - 1});
      if (cell == cells.end()) continue;
      for (const std::size_t other : cell->second) {
        const Vector3d away = x[k] - x[other];
        const double r = away.norm();
        if (other != k && r < reach && r > 0) push += kPush * spacing_ * (1 - r / reach) / r * away;
      }
    }
    return push;
  }

  const TriangleSurface& surface_;
  double spacing_, depth_;
  std::vector<Vector3d> points_;
  int counted_ = 0;
};

// Calls visit(x) for the points of a lattice in the box.
template <typename Visit>
void for_lattice(const Bounds& box, double spacing, const Visit& visit) {
  const Vector3d size = (box.max - box.min) / spacing;
  for (int c = 0; c < std::ceil(size.z()); ++c)
    for (int b = 0; b < std::ceil(size.y()); ++b)
      for (int a = 0; a < std::ceil(size.x()); ++a)
        visit(Vector3d(box.min + spacing * Vector3d(a + 0.5, b + 0.5, c + 0.5)));
}

}  // namespace

Boundary sample_mesh(const MeshShape& mesh, double spacing, int layers) {
  const TriangleSurface& surface = *mesh.surface;
  std::vector<Layer> layer;
  for (int l = 0; l < layers; ++l) layer.emplace_back(surface, spacing, l);
  const auto in_layer = [&](const Vector3d& x, const auto& act) {
    const double depth = surface.nearest(x).signed_distance;
    for (Layer& one : layer)
      if (one.holds(depth)) return act(one);
  };
  const Bounds box = bounds(mesh, 3);
  for_lattice(box, spacing, [&](const Vector3d& x) { in_layer(x, [&](Layer& one) { one.seed(x); }); });
  for_lattice(box, spacing / kCounting,
              [&](const Vector3d& x) { in_layer(x, [](Layer& one) { one.count(); }); });
  Boundary body;
  for (Layer& one : layer) one.add_to(body);
  return body;
}

}  // namespace sluice::fluid
