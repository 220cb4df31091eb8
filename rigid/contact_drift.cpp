#include "rigid/contact_drift.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

#include "rigid/bullet_shape.hpp"
#include "rigid/restitution.hpp"

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

// Bullet's bodies have diagonal inertia: their axes are the principal ones, turned from the body's by `turn`.
struct PrincipalAxes {
  Eigen::Quaterniond turn = Eigen::Quaterniond::Identity();
  Eigen::Vector3d inertia = Eigen::Vector3d::Zero();
};

PrincipalAxes principal_axes(const Eigen::Matrix3d& inertia) {
  if (inertia.isDiagonal(0)) return {Eigen::Quaterniond::Identity(), inertia.diagonal()};
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(inertia);
  Eigen::Matrix3d axes = solver.eigenvectors();
  if (axes.determinant() < 0) axes.col(0) = -axes.col(0);
  return {Eigen::Quaterniond(axes), solver.eigenvalues()};
}

}  // namespace

struct ContactDrift::Bullet {
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  KickedWorld world{&dispatcher, &broadphase, &solver, &configuration};
  BulletShapes shapes;
  std::vector<std::unique_ptr<btRigidBody>> walls, bodies;
  std::vector<Eigen::Quaterniond> turns;  // of the bodies' principal axes
  std::vector<Contact> contacts;          // of the bodies
  Contact wall_contact;
  int dimension;

  explicit Bullet(const WorldSpec& spec);
  ~Bullet();
  std::unique_ptr<btRigidBody> add(btCollisionShape& shape, const Contact& contact);
  void add_wall(const Tank& tank, int axis, bool upper);
  void add_body(const BodySpec& body, double half_depth);
  void set_free(std::size_t b, const FreeBody& free);
  void set_held(std::size_t b);
  [[nodiscard]] std::size_t index_of(const btCollisionObject* object) const;
  [[nodiscard]] std::vector<Touch> touches(double dt, std::span<const FreeBody::Drift> before,
                                           std::span<const FreeBody::Drift> after);
  void rebound(double dt, std::span<const FreeBody::Drift> before, std::span<FreeBody::Drift> after);
};

ContactDrift::Bullet::Bullet(const WorldSpec& spec) : wall_contact(spec.contact), dimension(spec.dimension) {
  // Enough contact points at once for a flat side to lie still.
  configuration.setPlaneConvexMultipointIterations();
  configuration.setConvexConvexMultipointIterations();
  world.setGravity(btVector3(0, 0, 0));  // applied by the kicks
  btContactSolverInfo& info = world.getSolverInfo();
  info.m_numIterations = kSolverIterations;
  info.m_splitImpulsePenetrationThreshold = 0;  // separation never adds momentum
  // An impact's impulses, kept as first guess for the next step, would throw the bodies apart again.
  info.m_solverMode &= ~SOLVER_USE_WARMSTARTING;
  btGImpactCollisionAlgorithm::registerAlgorithm(&dispatcher);
  for (int axis = 0; axis < spec.dimension; ++axis)
    for (const bool upper : {false, true})
      if (spec.tank.closed[2 * axis + upper]) add_wall(spec.tank, axis, upper);
}

ContactDrift::Bullet::~Bullet() {
  for (const auto& body : bodies) world.removeRigidBody(body.get());
  for (const auto& wall : walls) world.removeRigidBody(wall.get());
}

std::unique_ptr<btRigidBody> ContactDrift::Bullet::add(btCollisionShape& shape, const Contact& contact) {
  btRigidBody::btRigidBodyConstructionInfo info(0, nullptr, &shape, btVector3(0, 0, 0));
  info.m_friction = std::sqrt(contact.friction);  // Bullet multiplies those of the two bodies
  return std::make_unique<btRigidBody>(info);
}

void ContactDrift::Bullet::add_wall(const Tank& tank, int axis, bool upper) {
  const Eigen::Vector3d inward = (upper ? -1 : 1) * Eigen::Vector3d::Unit(axis);
  const double offset = upper ? -tank.max[axis] : tank.min[axis];
  walls.push_back(
      add(shapes.keep(std::make_unique<btStaticPlaneShape>(to_bullet(inward), offset)), wall_contact));
  walls.back()->setUserIndex(-1);
  world.addRigidBody(walls.back().get());
}

void ContactDrift::Bullet::add_body(const BodySpec& body, double half_depth) {
  const Eigen::Quaterniond turn =
      body.inertia ? principal_axes(*body.inertia).turn : Eigen::Quaterniond::Identity();
  turns.push_back(turn);
  contacts.push_back(body.contact);
  bodies.push_back(add(shapes.make(body.shape, dimension, half_depth, turn.conjugate()), body.contact));
  btRigidBody& added = *bodies.back();
  added.setUserIndex(static_cast<int>(bodies.size()) - 1);
  added.setCollisionFlags(btCollisionObject::CF_KINEMATIC_OBJECT);
  added.setFlags(0);                               // no gyroscopic term: the drift's angular velocity has it
  added.setActivationState(DISABLE_DEACTIVATION);  // sleeping bodies would ignore the fluid
  added.setWorldTransform(to_bullet(Pose{body.pose.position, body.pose.orientation * turn}));
  world.addRigidBody(&added);
}

void ContactDrift::Bullet::set_free(std::size_t b, const FreeBody& free) {
  btRigidBody& body = *bodies[b];
  world.removeRigidBody(&body);  // bodies that move by themselves are in another group
  body.setCollisionFlags(0);
  body.setMassProps(free.mass(), to_bullet(principal_axes(free.inertia()).inertia));
  body.setLinearFactor(to_bullet(free.free_axes()));
  body.setAngularFactor(to_bullet(free.free_turns()));
  body.updateInertiaTensor();
  body.setActivationState(DISABLE_DEACTIVATION);
  world.addRigidBody(&body);
}

void ContactDrift::Bullet::set_held(std::size_t b) {
  btRigidBody& body = *bodies[b];
  world.removeRigidBody(&body);
  body.setMassProps(0, btVector3(0, 0, 0));
  body.setCollisionFlags(btCollisionObject::CF_KINEMATIC_OBJECT);
  body.setActivationState(DISABLE_DEACTIVATION);
  world.addRigidBody(&body);
}

std::size_t ContactDrift::Bullet::index_of(const btCollisionObject* object) const {
  return object->getUserIndex() < 0 ? kWall : static_cast<std::size_t>(object->getUserIndex());
}

// The points whose gap is closed at the end of the drift. Bullet does not tell their impulses.
std::vector<Touch> ContactDrift::Bullet::touches(double dt, std::span<const FreeBody::Drift> before,
                                                 std::span<const FreeBody::Drift> after) {
  std::vector<Touch> found;
  for (int m = 0; m < dispatcher.getNumManifolds(); ++m) {
    const btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(m);
    const std::size_t a = index_of(manifold.getBody0()), b = index_of(manifold.getBody1());
    const Contact& of_a = a == kWall ? wall_contact : contacts[a];
    const Contact& of_b = b == kWall ? wall_contact : contacts[b];
    for (int p = 0; p < manifold.getNumContacts(); ++p) {
      const btManifoldPoint& point = manifold.getContactPoint(p);
      Touch touch;
      touch.a = a;
      touch.b = b;
      touch.normal = from_bullet(point.m_normalWorldOnB);
      const Eigen::Vector3d x = from_bullet(point.getPositionWorldOnA() + point.getPositionWorldOnB()) / 2;
      if (a != kWall) touch.arm_a = x - before[a].pose.position;
      if (b != kWall) touch.arm_b = x - before[b].pose.position;
      touch.gap = point.getDistance();
      touch.friction = std::sqrt(of_a.friction * of_b.friction);
      touch.restitution = std::max(of_a.restitution, of_b.restitution);
      if (!is_closed(touch, before, after, dt)) continue;
      find_impact(touch, before, dt);
      found.push_back(touch);
    }
  }
  return found;
}

// Bullet's own restitution acts on contacts that it sees coming, while the gap is still open; here it is
// zero, bodies come to touch, and the pass over the points that did throws them back.
void ContactDrift::Bullet::rebound(double dt, std::span<const FreeBody::Drift> before,
                                   std::span<FreeBody::Drift> after) {
  const auto bounces = [](const Contact& contact) { return contact.restitution > 0; };
  if (!bounces(wall_contact) && std::none_of(contacts.begin(), contacts.end(), bounces)) return;
  const std::vector<Touch> found = touches(dt, before, after);
  if (std::none_of(found.begin(), found.end(), [](const Touch& touch) { return touch.is_impact; })) return;
  std::vector<Inertia> inertia(bodies.size());
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const btRigidBody& body = *bodies[b];
    if (body.isKinematicObject()) continue;
    inertia[b].inverse_mass = body.getInvMass() * from_bullet(body.getLinearFactor());
    const Eigen::Vector3d turns_free = from_bullet(body.getAngularFactor());
    inertia[b].inverse_inertia =
        turns_free.asDiagonal() * from_bullet(body.getInvInertiaTensorWorld()) * turns_free.asDiagonal();
  }
  throw_back(dt, found, inertia, before, after);
}

ContactDrift::ContactDrift(const WorldSpec& spec, std::span<const FreeBody* const> free)
    : bullet_(std::make_unique<Bullet>(spec)) {
  double half_depth = 0;
  // Deeper than any overlap in the plane, so that contact normals stay in it.
  for (const BodySpec& body : spec.bodies)
    half_depth = std::max(half_depth, 2 * bounding_radius(body.shape, spec.dimension));
  for (const BodySpec& body : spec.bodies) bullet_->add_body(body, half_depth);
  for (std::size_t b = 0; b < spec.bodies.size(); ++b)
    if (free[b] != nullptr) bullet_->set_free(b, *free[b]);
  // Bodies that are joined overlap at the joint.
  for (const JointSpec& joint : spec.joints)
    if (joint.b != kWorld)
      bullet_->bodies[joint.a]->setIgnoreCollisionCheck(bullet_->bodies[joint.b].get(), true);
}

ContactDrift::~ContactDrift() = default;

void ContactDrift::release(std::size_t b, const FreeBody& free) {
  bullet_->set_free(b, free);
}

void ContactDrift::hold(std::size_t b) {
  bullet_->set_held(b);
}
void ContactDrift::step(double dt, std::span<FreeBody::Drift> bodies) {
  const std::vector<FreeBody::Drift> before(bodies.begin(), bodies.end());
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    btRigidBody& body = *bullet_->bodies[b];
    const Pose& pose = bodies[b].pose;
    body.setCenterOfMassTransform(to_bullet(Pose{pose.position, pose.orientation * bullet_->turns[b]}));
    body.setLinearVelocity(to_bullet(bodies[b].velocity));
    body.setAngularVelocity(to_bullet(bodies[b].angular_velocity));
  }
  bullet_->world.getSolverInfo().m_erp2 = std::min(0.2, dt / kSeparationTime);
  bullet_->world.stepSimulation(dt, 0);  // exactly one step of dt
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const btRigidBody& body = *bullet_->bodies[b];
    if (body.isKinematicObject()) continue;
    bodies[b].pose = from_bullet(body.getWorldTransform());
    bodies[b].pose.orientation = bodies[b].pose.orientation * bullet_->turns[b].conjugate();
    bodies[b].velocity = from_bullet(body.getLinearVelocity());
    bodies[b].angular_velocity = from_bullet(body.getAngularVelocity());
  }
  bullet_->rebound(dt, before, bodies);
}

void ContactDrift::drop_contacts() {
  btOverlappingPairCache& cache = *bullet_->broadphase.getOverlappingPairCache();
  btBroadphasePairArray& pairs = cache.getOverlappingPairArray();
  for (int p = 0; p < pairs.size(); ++p) cache.cleanOverlappingPair(pairs[p], &bullet_->dispatcher);
  bullet_->solver.reset();
}

}  // namespace sluice::rigid
