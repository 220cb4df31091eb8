#include "rigid/bullet_shape.hpp"

namespace sluice::rigid {
namespace {

// Bullet rounds shapes by a margin of 0.04 m, which would swallow small bodies. In double precision its
// distance algorithm does with this share of half the thickness, and with none where polyhedra are clipped on
// each other.
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

std::unique_ptr<btCollisionShape> make(const Polygon& polygon, int, double half_depth) {
  auto shape = std::make_unique<btConvexHullShape>();
  shape->setMargin(0);
  for (const Eigen::Vector2d& vertex : polygon.vertices)
    for (const double z : {-half_depth, half_depth})
      shape->addPoint(btVector3(vertex.x(), vertex.y(), z), false);
  shape->recalcLocalAabb();
  shape->initializePolyhedralFeatures();
  return shape;
}

}  // namespace

std::unique_ptr<btCollisionShape> make_bullet_shape(const Shape& shape, int dimension, double half_depth) {
  return std::visit([&](const auto& s) { return make(s, dimension, half_depth); }, shape);
}

}  // namespace sluice::rigid
