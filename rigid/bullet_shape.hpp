#pragma once

// Internal: the only headers that show Bullet are bullet_*.hpp.
#include <btBulletDynamicsCommon.h>

#include <memory>

#include "rigid/shape.hpp"

static_assert(sizeof(btScalar) == 8, "sluice needs Bullet in double precision (pkg-config bullet-float64)");

namespace sluice::rigid {

inline btVector3 to_bullet(const Eigen::Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}
inline Eigen::Vector3d from_bullet(const btVector3& v) {
  return {v.x(), v.y(), v.z()};
}

inline btTransform to_bullet(const Pose& pose) {
  const Eigen::Quaterniond& q = pose.orientation;
  return btTransform(btQuaternion(q.x(), q.y(), q.z(), q.w()), to_bullet(pose.position));
}
inline Pose from_bullet(const btTransform& transform) {
  const btQuaternion q = transform.getRotation();
  return {from_bullet(transform.getOrigin()), Eigen::Quaterniond(q.w(), q.x(), q.y(), q.z())};
}

// The shape for contact. In two dimensions it is extruded to z = -half_depth .. half_depth.
std::unique_ptr<btCollisionShape> make_bullet_shape(const Shape& shape, int dimension, double half_depth);

}  // namespace sluice::rigid
