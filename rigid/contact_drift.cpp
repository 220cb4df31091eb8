#include "rigid/contact_drift.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "rigid/bullet_shape.hpp"

namespace sluice::rigid {
namespace {

// Time in which Bullet moves penetrating bodies apart by 63 % [s]. A share per step, Bullet's own parameter,
// would throw bodies apart at a speed that grows as the step shrinks.
constexpr double kSeparationTime = 0.01;
constexpr int kSolverIterations = 50;

// Bullet would derive the velocity of kinematic bodies from their last two poses; here it is given, so that
// contact sees the pose at the start of the step together with the velocity over the step.
class KickedWorld final : public btDiscreteDynamicsWorld {
 public:
  using btDiscreteDynamicsWorld::btDiscreteDynamicsWorld;
  void saveKinematicState(btScalar) override {}
};

}  // namespace

struct ContactDrift::Bullet {
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  KickedWorld world{&dispatcher, &broadphase, &solver, &configuration};
  std::vector<std::unique_ptr<btCollisionShape>> shapes;
  std::vector<std::unique_ptr<btRigidBody>> walls, bodies;

  explicit Bullet(const WorldSpec& spec);
  ~Bullet();
  std::unique_ptr<btRigidBody> add(std::unique_ptr<btCollisionShape> shape, double friction, double mass,
                                   const Eigen::Vector3d& inertia);
  void add_wall(const Tank& tank, int axis, bool upper, double friction);
  void add_body(const BodySpec& body, const FreeBody* free, const WorldSpec& spec, double half_depth);
};

ContactDrift::Bullet::Bullet(const WorldSpec& spec) {
  // Enough contact points at once for a flat side to lie still.
  configuration.setPlaneConvexMultipointIterations();
  configuration.setConvexConvexMultipointIterations();
  world.setGravity(btVector3(0, 0, 0));  // applied by the kicks
  btContactSolverInfo& info = world.getSolverInfo();
  info.m_numIterations = kSolverIterations;
  info.m_splitImpulsePenetrationThreshold = 0;  // separation never adds momentum
  // An impact's impulses, kept as first guess for the next step, would throw the bodies apart again.
  info.m_solverMode &= ~SOLVER_USE_WARMSTARTING;
  for (int axis = 0; axis < spec.dimension; ++axis)
    for (const bool upper : {false, true})
      if (spec.tank.closed[2 * axis + upper]) add_wall(spec.tank, axis, upper, spec.friction);
}

ContactDrift::Bullet::~Bullet() {
  for (const auto& body : bodies) world.removeRigidBody(body.get());
  for (const auto& wall : walls) world.removeRigidBody(wall.get());
}

std::unique_ptr<btRigidBody> ContactDrift::Bullet::add(std::unique_ptr<btCollisionShape> shape,
                                                       double friction, double mass,
                                                       const Eigen::Vector3d& inertia) {
  btRigidBody::btRigidBodyConstructionInfo info(mass, nullptr, shape.get(), to_bullet(inertia));
  info.m_friction = std::sqrt(friction);  // Bullet multiplies those of the two bodies
  shapes.push_back(std::move(shape));
  return std::make_unique<btRigidBody>(info);
}

void ContactDrift::Bullet::add_wall(const Tank& tank, int axis, bool upper, double friction) {
  const Eigen::Vector3d inward = (upper ? -1 : 1) * Eigen::Vector3d::Unit(axis);
  const double offset = upper ? -tank.max[axis] : tank.min[axis];
  walls.push_back(add(std::make_unique<btStaticPlaneShape>(to_bullet(inward), offset), friction, 0,
                      Eigen::Vector3d::Zero()));
  world.addRigidBody(walls.back().get());
}

void ContactDrift::Bullet::add_body(const BodySpec& body, const FreeBody* free, const WorldSpec& spec,
                                    double half_depth) {
  const Eigen::Vector3d inertia =
      free != nullptr ? free->inertia() : Eigen::Vector3d(Eigen::Vector3d::Zero());
  bodies.push_back(add(make_bullet_shape(body.shape, spec.dimension, half_depth), spec.friction,
                       free != nullptr ? free->mass() : 0, inertia));
  btRigidBody& added = *bodies.back();
  if (free == nullptr) added.setCollisionFlags(btCollisionObject::CF_KINEMATIC_OBJECT);
  if (spec.dimension == 2) {
    added.setLinearFactor(btVector3(1, 1, 0));
    added.setAngularFactor(btVector3(0, 0, 1));
  }
  added.setFlags(0);                               // no gyroscopic term: the drift's angular velocity has it
  added.setActivationState(DISABLE_DEACTIVATION);  // sleeping bodies would ignore the fluid
  added.setWorldTransform(to_bullet(body.pose));
  world.addRigidBody(&added);
}

ContactDrift::ContactDrift(const WorldSpec& spec, std::span<const FreeBody* const> free)
    : bullet_(std::make_unique<Bullet>(spec)) {
  double half_depth = 0;
  // Deeper than any overlap in the plane, so that contact normals stay in it.
  for (const BodySpec& body : spec.bodies)
    half_depth = std::max(half_depth, 2 * bounding_radius(body.shape, spec.dimension));
  for (std::size_t b = 0; b < spec.bodies.size(); ++b)
    bullet_->add_body(spec.bodies[b], free[b], spec, half_depth);
}

ContactDrift::~ContactDrift() = default;

void ContactDrift::step(double dt, std::span<FreeBody::Drift> bodies) {
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    btRigidBody& body = *bullet_->bodies[b];
    body.setCenterOfMassTransform(to_bullet(bodies[b].pose));
    body.setLinearVelocity(to_bullet(bodies[b].velocity));
    body.setAngularVelocity(to_bullet(bodies[b].angular_velocity));
  }
  bullet_->world.getSolverInfo().m_erp2 = std::min(0.2, dt / kSeparationTime);
  bullet_->world.stepSimulation(dt, 0);  // exactly one step of dt
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const btRigidBody& body = *bullet_->bodies[b];
    if (body.isKinematicObject()) continue;
    bodies[b] = {from_bullet(body.getWorldTransform()), from_bullet(body.getLinearVelocity()),
                 from_bullet(body.getAngularVelocity())};
  }
}

void ContactDrift::drop_contacts() {
  btOverlappingPairCache& cache = *bullet_->broadphase.getOverlappingPairCache();
  btBroadphasePairArray& pairs = cache.getOverlappingPairArray();
  for (int p = 0; p < pairs.size(); ++p) cache.cleanOverlappingPair(pairs[p], &bullet_->dispatcher);
  bullet_->solver.reset();
}

}  // namespace sluice::rigid
