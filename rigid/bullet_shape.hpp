#pragma once

// Internal: the only headers that show Bullet are bullet_*.hpp.
#include <BulletCollision/Gimpact/btGImpactCollisionAlgorithm.h>
#include <BulletCollision/Gimpact/btGImpactShape.h>
#include <btBulletDynamicsCommon.h>

#include <memory>
#include <vector>

#include "rigid/shape.hpp"

static_assert(sizeof(btScalar) == 8, "sluice needs Bullet in double precision (pkg-config bullet-float64)");

namespace sluice::rigid {

inline btVector3 to_bullet(const Eigen::Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}
inline Eigen::Vector3d from_bullet(const btVector3& v) {
  return {v.x(), v.y(), v.z()};
}
inline Eigen::Matrix3d from_bullet(const btMatrix3x3& m) {
  Eigen::Matrix3d matrix;
  for (int row = 0; row < 3; ++row) matrix.row(row) = from_bullet(m[row]).transpose();
  return matrix;
}

inline btTransform to_bullet(const Pose& pose) {
  const Eigen::Quaterniond& q = pose.orientation;
  return btTransform(btQuaternion(q.x(), q.y(), q.z(), q.w()), to_bullet(pose.position));
}
inline Pose from_bullet(const btTransform& transform) {
  const btQuaternion q = transform.getRotation();
  return {from_bullet(transform.getOrigin()), Eigen::Quaterniond(q.w(), q.x(), q.y(), q.z())};
}

// Makes shapes for contact and keeps them and their parts.
class BulletShapes {
 public:
  BulletShapes() = default;
  BulletShapes(const BulletShapes&) = delete;
  BulletShapes& operator=(const BulletShapes&) = delete;
  ~BulletShapes();

  // In two dimensions it is extruded to z = -half_depth .. half_depth. `turn` turns the shape.
  btCollisionShape& make(const Shape& shape, int dimension, double half_depth,
                         const Eigen::Quaterniond& turn);
  btCollisionShape& keep(std::unique_ptr<btCollisionShape> shape);

 private:
  btCollisionShape& make_surface(const Mesh& mesh, const Eigen::Quaterniond& turn);
  btCollisionShape& make_compound(const Compound& compound, int dimension, double half_depth,
                                  const Eigen::Quaterniond& turn);

  std::vector<std::unique_ptr<btTriangleMesh>> surfaces_;
  std::vector<std::unique_ptr<btCollisionShape>> shapes_;
};

}  // namespace sluice::rigid
