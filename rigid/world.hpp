#pragma once

#include <array>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "rigid/joint.hpp"
#include "rigid/kinematics.hpp"
#include "rigid/motion.hpp"
#include "rigid/shape.hpp"

namespace sluice::rigid {

// How a body or wall touches others: of two, the geometric mean of the frictions and the larger restitution
// count.
struct Contact {
  double friction = 0.3;   // Coulomb coefficient [-]
  double restitution = 0;  // normal speed after an impact over that before, 0 to 1 [-]
};

struct BodySpec {
  std::string name;
  Shape shape;
  Pose pose;  // at time 0
  // Of a free body: mass [kg] (per metre of depth in two dimensions) and twist at time 0 [m/s], [rad/s].
  double mass = 0;
  // About the centre of mass, in the body's frame [kg m^2]; without it that of a homogeneous body.
  std::optional<Eigen::Matrix3d> inertia;
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
  Eigen::Vector3d angular_velocity = Eigen::Vector3d::Zero();
  Contact contact;
  std::array<bool, 3> locked{}, locked_rotation{};  // world axes along, about which a free body does not move
  MotionPtr motion;                                 // prescribed; null: free
  // With a motion: world axes along and about which the body is free all the same, from the twist above; the
  // motion has nothing along them. If there are any the body needs a mass.
  std::array<bool, 3> free{}, free_rotation{};
  // With a motion: from the first step that begins at or after this time on the body is free [s].
  double release = std::numeric_limits<double>::infinity();
};

// Whether a motion moves the body along some axes only.
bool is_guided(const BodySpec& body);

// Walls on the closed sides of a box. A wall is a whole plane: it goes on beyond the corners of the box.
struct Tank {
  Eigen::Vector3d min = Eigen::Vector3d::Zero(), max = Eigen::Vector3d::Zero();  // [m]
  std::array<bool, 6> closed{};  // lower and upper side of x, y, z
};

struct WorldSpec {
  int dimension = 2;
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();  // [m/s^2]
  Tank tank;
  Contact contact;  // of the walls
  std::vector<JointSpec> joints;
  std::vector<BodySpec> bodies;
};

// All bodies of a scene, integrated by kick-drift-kick (README.md). A step is predict, then correct with the
// wrenches that answer the prediction; where all bodies are prescribed, predict alone.
class World {
 public:
  // Throws std::invalid_argument naming the body when a free one has no mass, or a motion does not start at
  // zero.
  explicit World(WorldSpec spec);
  ~World();
  World(World&&) noexcept;
  World& operator=(World&&) noexcept;

  // The fluid's action at time 0. Without it the bodies start under gravity alone.
  void start(std::span<const Wrench> wrenches);

  // Advances all poses by `dt` to the time `end` [s]; prescribed bodies stand where their motion is at `end`.
  // Throws std::runtime_error naming the body when a free one turns by more than pi/4 or is no longer finite.
  std::vector<Kinematics> predict(double end, double dt);

  // Finishes the step that predict began, with the fluid's action at its end; those of prescribed bodies are
  // not read. Throws std::invalid_argument when there is not one finite wrench for every body.
  void correct(double dt, std::span<const Wrench> wrenches);

  // Adds momentum [N s] and angular momentum [N m s] to the free bodies.
  void push(std::span<const Wrench> impulses);

  // Keeps the state of the bodies in memory, and goes back to it. Contact points are dropped by both, so that
  // every start from the saved state is the same.
  void save();
  void restore();

  // Makes anew what contact keeps between steps. What follows then depends on the state of the bodies alone,
  // so that a world which read that state goes on to the last bit as this one does.
  void renew_contact();
  // The state of the bodies as numbers, and back into a world made from the same spec, whose contact is made
  // anew. read_state gives what is left of the row; throws std::invalid_argument when it ends too early.
  [[nodiscard]] std::vector<double> write_state();
  std::span<const double> read_state(std::span<const double> row);

  [[nodiscard]] std::size_t size() const;
  // At present.
  [[nodiscard]] bool is_free(std::size_t body) const;
  // Of a free body [kg].
  [[nodiscard]] double mass(std::size_t body) const;
  // Kinetic energy that an impulse would give to a free body at rest in its present orientation [J].
  [[nodiscard]] double impulse_energy(std::size_t body, const Wrench& impulse) const;
  // Now or later.
  [[nodiscard]] bool has_free_bodies() const;
  // State at the end of the last whole step, with the velocities at that instant. For bodies that are free by
  // then.
  [[nodiscard]] Kinematics state(std::size_t body) const;
  // Of a free body, at the same time.
  [[nodiscard]] Account account(std::size_t body) const;
  // Kinetic energy of a free body at the end of the last whole step [J].
  [[nodiscard]] double kinetic_energy(std::size_t body) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace sluice::rigid
