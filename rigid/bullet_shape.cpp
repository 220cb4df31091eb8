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

std::unique_ptr<btCollisionShape> make(const Cylinder& cylinder, int, double) {
  btVector3 half(cylinder.radius, cylinder.radius, cylinder.radius);
  half[cylinder.axis] = cylinder.half_length;
  std::unique_ptr<btCylinderShape> shape;
  if (cylinder.axis == 0) shape = std::make_unique<btCylinderShapeX>(half);
  if (cylinder.axis == 1) shape = std::make_unique<btCylinderShape>(half);
  if (cylinder.axis == 2) shape = std::make_unique<btCylinderShapeZ>(half);
  shape->setMargin(kMarginShare * std::min(cylinder.radius, cylinder.half_length));
  return shape;
}

// The hull of the vertices, turned.
std::unique_ptr<btConvexHullShape> make_hull(const Mesh& mesh, const Eigen::Quaterniond& turn) {
  auto shape = std::make_unique<btConvexHullShape>();
  shape->setMargin(0);
  for (const Eigen::Vector3d& vertex : mesh.vertices) shape->addPoint(to_bullet(turn * vertex), false);
  shape->recalcLocalAabb();
  shape->initializePolyhedralFeatures();
  return shape;
}

}  // namespace

BulletShapes::~BulletShapes() = default;

btCollisionShape& BulletShapes::keep(std::unique_ptr<btCollisionShape> shape) {
  return *shapes_.emplace_back(std::move(shape));
}

btCollisionShape& BulletShapes::make_surface(const Mesh& mesh, const Eigen::Quaterniond& turn) {
  auto triangles = std::make_unique<btTriangleMesh>();
  for (const auto& [a, b, c] : mesh.triangles)
    triangles->addTriangle(to_bullet(turn * mesh.vertices[a]), to_bullet(turn * mesh.vertices[b]),
                           to_bullet(turn * mesh.vertices[c]));
  auto shape = std::make_unique<btGImpactMeshShape>(triangles.get());
  surfaces_.push_back(std::move(triangles));
  shape->setMargin(kMarginShare * thickness(mesh, 3));
  shape->updateBound();
  return keep(std::move(shape));
}

btCollisionShape& BulletShapes::make_compound(const Compound& compound, int dimension, double half_depth,
                                              const Eigen::Quaterniond& turn) {
  auto shape = std::make_unique<btCompoundShape>();
  for (const Placed& part : compound.parts) {
    const Pose pose = in_world({Eigen::Vector3d::Zero(), turn}, part.pose);
    shape->addChildShape(to_bullet(pose),
                         &make(part.shape, dimension, half_depth, Eigen::Quaterniond::Identity()));
  }
  return keep(std::move(shape));
}

btCollisionShape& BulletShapes::make(const Shape& shape, int dimension, double half_depth,
                                     const Eigen::Quaterniond& turn) {
  if (const auto* mesh = std::get_if<Mesh>(&shape))
    return mesh->convex ? keep(make_hull(*mesh, turn)) : make_surface(*mesh, turn);
  if (const auto* compound = std::get_if<Compound>(&shape))
    return make_compound(*compound, dimension, half_depth, turn);
  if (!turn.vec().isZero(0)) return make_compound({{{shape, {}}}}, dimension, half_depth, turn);
  if (const auto* box = std::get_if<Box>(&shape)) return keep(rigid::make(*box, dimension, half_depth));
  if (const auto* ball = std::get_if<Ball>(&shape)) return keep(rigid::make(*ball, dimension, half_depth));
  if (const auto* cylinder = std::get_if<Cylinder>(&shape))
    return keep(rigid::make(*cylinder, dimension, half_depth));
  return keep(rigid::make(std::get<Polygon>(shape), dimension, half_depth));
}

}  // namespace sluice::rigid
