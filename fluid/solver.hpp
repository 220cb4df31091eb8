#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "fluid/kinematics.hpp"
#include "fluid/setup.hpp"

namespace sluice::fluid {

// Copy of the state of the particles in the tank by rising number, whatever the solver's own order is: the
// order of FluidParticles, then what came in through openings. Numbers are not used again.
struct Snapshot {
  std::vector<double> position;      // [n, 3]
  std::vector<double> velocity;      // [n, 3]
  std::vector<double> density;       // [n]
  std::vector<double> pressure;      // [n]
  std::vector<std::uint32_t> id;     // [n] number; 0 to n - 1 without openings
  std::vector<std::uint8_t> liquid;  // [n] number in Setup::liquids; empty with one liquid
};

// What goes through an opening, per metre of depth in 2D.
struct Passage {
  double mass_in = 0, mass_out = 0;  // since the start [kg]
  double rate = 0;                   // of what is behind the opening, into the tank [kg/s]
};

// Sums over the fluid particles; per metre of depth in 2D.
struct Diagnostics {
  double kinetic = 0;    // [J]
  double potential = 0;  // - sum m g.x [J]
  double elastic = 0;    // work stored in compression and in the free surface [J]
  double surface = 0;    // of that in the free surface [J]
  // Done on the fluid by moving boundaries, and brought in less taken out through openings, since the start
  // [J]
  double boundary_work = 0;
  Eigen::Vector3d momentum = Eigen::Vector3d::Zero();          // [kg m/s]
  Eigen::Vector3d angular_momentum = Eigen::Vector3d::Zero();  // about the origin [kg m^2/s]
  double max_speed = 0;                                        // [m/s]
  double max_compression = 0;                                  // max |rho/rho0 - 1|
  double mass = 0;                                             // [kg]
  std::vector<Passage> openings;                               // as in Setup
};

// Wall clock of all steps so far, and of their stages [s]; the rest are passes over the particles.
struct StageTimes {
  double search = 0;     // neighbour lists, sorting
  double boundary = 0;   // what boundary particles take from the fluid
  double gradients = 0;  // sweep 1
  double forces = 0;     // sweep 2
  double reactions = 0;  // wrenches on bodies and walls
  double steps = 0;
};

// Liquids, walls and moving bodies, stepped explicitly. Holds no global state.
class Solver {
 public:
  virtual ~Solver() = default;

  // Sets the bodies' poses at time 0 and computes the first forces. Call once before step.
  virtual void start(std::span<const Kinematics> bodies) = 0;

  // Advances by dt [s]. bodies[b] is the motion of setup.bodies[b] over this step. Afterwards wrenches()
  // holds the fluid's action on each body at the end of the step. Precondition: dt <= largest_step().
  virtual void step(double dt, std::span<const Kinematics> bodies) = 0;

  // Keeps the state in memory, and goes back to it: what follows is what followed the first time, to the last
  // bit, if the same kinematics are given. One state is kept; restore may be called again. Precondition of
  // restore: save was called.
  virtual void save() = 0;
  virtual void restore() = 0;

  // The state between two steps as bytes, in the place of what was in them, and back, in place of start(),
  // into a solver that was made from the same setup by the same program on the same class of processor: what
  // follows is what would have followed, to the last bit. read_state throws std::invalid_argument when the
  // bytes are not of such a solver.
  virtual void write_state(std::vector<std::byte>& bytes) = 0;
  virtual void read_state(std::span<const std::byte> bytes) = 0;

  [[nodiscard]] virtual std::span<const Wrench> wrenches() const = 0;
  // Of the same bodies at the same time. Costs a look at every pair of fluid and body.
  [[nodiscard]] virtual std::vector<WrenchParts> wrench_parts() const = 0;
  // The fluid's action on the walls, moment about the origin; zero unless setup.measure_wall_force.
  [[nodiscard]] virtual Wrench wall_wrench() const = 0;

  // Courant limit [s] for speeds up to `max_speed` [m/s].
  [[nodiscard]] virtual double largest_step(double max_speed) const = 0;
  [[nodiscard]] virtual Snapshot snapshot() const = 0;
  [[nodiscard]] virtual Diagnostics diagnostics() const = 0;
  [[nodiscard]] virtual StageTimes stage_times() const = 0;
};

// Throws std::invalid_argument naming the value when the setup is not usable.
std::unique_ptr<Solver> make_solver(const Setup& setup);

}  // namespace sluice::fluid
