#include "rigid/bullet_overlap.hpp"

#include <algorithm>

#include "rigid/bullet_shape.hpp"

namespace sluice::rigid {
namespace {

// The deepest of the contact points that it is told.
struct Deepest final : btCollisionWorld::ContactResultCallback {
  double depth = 0;

  btScalar addSingleResult(btManifoldPoint& point, const btCollisionObjectWrapper*, int, int,
                           const btCollisionObjectWrapper*, int, int) override {
    depth = std::max(depth, -point.getDistance());
    return 0;
  }
};

}  // namespace

double bullet_penetration(const Placed& a, const Placed& b) {
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher(&configuration);
  btGImpactCollisionAlgorithm::registerAlgorithm(&dispatcher);
  btDbvtBroadphase broadphase;
  btCollisionWorld world(&dispatcher, &broadphase, &configuration);
  BulletShapes shapes;
  const auto object = [&](const Placed& placed, btCollisionObject& made) {
    made.setCollisionShape(&shapes.make(placed.shape, 3, 0, Eigen::Quaterniond::Identity()));
    made.setWorldTransform(to_bullet(placed.pose));
  };
  btCollisionObject first, second;
  object(a, first);
  object(b, second);
  Deepest deepest;
  world.contactPairTest(&first, &second, deepest);
  return deepest.depth;
}

}  // namespace sluice::rigid
