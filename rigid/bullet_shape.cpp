#include "rigid/bullet_shape.hpp"

namespace sluice::rigid {
namespace {

// Bullet's margin rounds corners, and contact points found near a corner are off by a part of it, which lets
// a polygon settle by that much. In double precision this share of half the thickness is enough for its
// distance algorithm; the default of 0.04 m would swallow small bodies.
constexpr double kMarginShare = 1e-5;

std::unique_ptr<btCollisionShape> make(const Box& box, int dimension, double half_depth) {
  Eigen::Vector3d half = box.half_size;
  if (dimension == 2) half.z() = half_depth;
  auto shape = std::make_unique<btBoxShape>(to_bullet(half));
  shape->setMargin(kMarginShare * half.minCoeff());
  shape->initializePolyhedralFeatures();
  return shape;
}

std::unique_ptr<btCollisionShape> make(const Ball& ball, int dimension, double half_depth) {
  if (dimension == 3) return std::make_unique<btSphereShape>(ball.radius);
  auto shape = std::make_unique<btCylinderShapeZ>(btVector3(ball.radius, ball.radius, half_depth));
  shape->setMargin(kMarginShare * ball.radius);
  return shape;
}

// Vertex i moved inward so that both its edges move by `distance`.
Eigen::Vector2d inset(const std::vector<Eigen::Vector2d>& v, std::size_t i, double distance) {
  const auto inward = [](const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
    const Eigen::Vector2d edge = (to - from).normalized();
    return Eigen::Vector2d(-edge.y(), edge.x());
  };
  const Eigen::Vector2d a = inward(v[(i + v.size() - 1) % v.size()], v[i]),
                        b = inward(v[i], v[(i + 1) % v.size()]);
  return v[i] + distance / (1 + a.dot(b)) * (a + b);
}

// Bullet adds a hull's margin outside, so the hull is drawn in by it.
std::unique_ptr<btCollisionShape> make(const Polygon& polygon, int dimension, double half_depth) {
  const double margin = kMarginShare * thickness(polygon, dimension) / 2;
  auto shape = std::make_unique<btConvexHullShape>();
  for (std::size_t i = 0; i < polygon.vertices.size(); ++i) {
    const Eigen::Vector2d corner = inset(polygon.vertices, i, margin);
    for (const double z : {-half_depth + margin, half_depth - margin})
      shape->addPoint(btVector3(corner.x(), corner.y(), z), false);
  }
  shape->setMargin(margin);
  shape->recalcLocalAabb();
  shape->initializePolyhedralFeatures();
  return shape;
}

}  // namespace

std::unique_ptr<btCollisionShape> make_bullet_shape(const Shape& shape, int dimension, double half_depth) {
  return std::visit([&](const auto& s) { return make(s, dimension, half_depth); }, shape);
}

}  // namespace sluice::rigid
