#pragma once

#include <optional>
#include <type_traits>

#include "fluid/background_cells.hpp"
#include "fluid/body_images.hpp"
#include "fluid/body_step.hpp"
#include "fluid/boundary.hpp"
#include "fluid/boundary_forces.hpp"
#include "fluid/checkpoint.hpp"
#include "fluid/crowding.hpp"
#include "fluid/films.hpp"
#include "fluid/force_sweep.hpp"
#include "fluid/group_stages.hpp"
#include "fluid/history.hpp"
#include "fluid/lagged_acceleration.hpp"
#include "fluid/mirror_guard.hpp"
#include "fluid/model.hpp"
#include "fluid/neighbor_search.hpp"
#include "fluid/openings.hpp"
#include "fluid/parallel.hpp"
#include "fluid/particles.hpp"
#include "fluid/shifting.hpp"
#include "fluid/solver.hpp"
#include "fluid/stopwatch.hpp"
#include "fluid/surface_tension.hpp"

namespace sluice::fluid {

// The Galerkin MLS scheme with nodal quadrature in Dim dimensions. The order inside a step matters: density
// advanced with velocities older than the positions is unstable.
template <int Dim, typename Kernel>
class GalerkinSolver final : public Solver {
 public:
  // Whether the sweeps have a version by groups of particles.
  static constexpr bool kHasGroups = std::is_same_v<Kernel, WendlandC2<Dim>>;

  explicit GalerkinSolver(const Setup& setup);

  void start(std::span<const Kinematics> bodies) override;
  void step(double dt, std::span<const Kinematics> bodies) override;

  void save() override;
  void restore() override;
  void write_state(std::vector<std::byte>& bytes) override;
  void read_state(std::span<const std::byte> bytes) override;

  [[nodiscard]] std::span<const Wrench> wrenches() const override;
  [[nodiscard]] std::vector<WrenchParts> wrench_parts() const override;
  [[nodiscard]] Wrench wall_wrench() const override { return wrench_[0]; }
  [[nodiscard]] double largest_step(double max_speed) const override;
  [[nodiscard]] Snapshot snapshot() const override;
  [[nodiscard]] Diagnostics diagnostics() const override;
  [[nodiscard]] StageTimes stage_times() const override { return times_; }

 private:
  // The integrators; all but the first in integrators.hpp.
  void kick_drift_kick(double dt, std::span<const Kinematics> bodies);
  void finish_with_openings(double dt);
  void leap_frog(double dt, std::span<const Kinematics> bodies);
  void predictor_corrector(double dt, std::span<const Kinematics> bodies);
  void multistep(double dt, std::span<const Kinematics> bodies);
  void start_history();
  void find_initial_parameters();
  void interpolate_velocities();
  // drift, and what follows from the new positions but the gradients
  void move(double dt, std::span<const Kinematics> bodies);
  void shift_and_place(double dt, std::span<const Kinematics> bodies);
  // `moved2` is how far the fluid has moved since the lists were made, squared, if that is known [m^2].
  void place(double dt, std::span<const Kinematics> bodies, std::optional<double> moved2 = {});
  // From the density on: the forces, with which the volumes go on to the next step.
  void evaluate_forces();
  void evaluate();
  // From the stress on: the forces, and what follows from them.
  void compute_actions();
  void take_reactions();

  // The stages of a step, in their order. Those of a single particle i can share a pass over all.
  void kick(double dt);
  void kick(std::size_t i, double dt) { fluid_.node[i].v += dt * fluid_.acceleration[i]; }
  void drift(double dt);
  void drift(std::size_t i, double dt) { fluid_.node[i].x += dt * fluid_.node[i].v; }
  void move_boundary(double dt, std::span<const Kinematics> bodies);
  void find_neighbors(std::optional<double> moved2 = {});
  void hold_openings(double dt);
  void mirror_velocities();
  void compute_gradients();
  void advance_density(double dt);
  void advance_density(std::size_t i, double dt);
  [[nodiscard]] double quadrature_volume(std::size_t i) const;
  void compute_stress();
  void set_stress(std::size_t i);
  void set_source(std::size_t i);
  void complete_stress();
  void extrapolate_to_boundary();
  void return_forces();
  void compute_forces();
  void collect_wrenches();
  void update_volumes();
  void update_volume(std::size_t i);
  void update_boundary_volumes();

  // All that a step changes but the neighbour search.
  auto state() {
    return std::tie(coefficients_, fluid_, boundary_, surface_, shifting_, crowding_, bodies_, lagged_,
                    reaction_, wrench_, last_wrench_, history_, interpolated_, boundary_work_, openings_,
                    surface_tension_);
  }

  [[nodiscard]] GroupStages<Dim> group_stages() requires kHasGroups {
    return {model_, search_.groups(), parallel_, close_};
  }
  void compute_single_gradients();
  void compute_single_forces();
  void relieve_tension();
  // Of several liquids, in galerkin_liquids.hpp.
  void separate_liquids();
  void separate_at_interface(std::size_t i);
  void compute_own_stress();
  void compute_liquid_forces();
  void find_films();
  void spread_crowds(double dt);
  void compute_reactions();
  [[nodiscard]] Wrench wrench_on_sides() const;
  void add_impulse(double dt);
  [[nodiscard]] std::vector<std::uint32_t> measured_groups() const;
  template <typename Visit>
  void for_active_boundary(const Visit& visit) const;
  // Calls visit(k) for the fluid near fluid particle i, and maybe others beyond the support.
  template <typename Visit>
  void for_fluid_near(std::size_t i, const Visit& visit) const;
  [[nodiscard]] std::span<const std::uint32_t> fluid_near_boundary(std::size_t w,
                                                                   std::vector<std::uint32_t>& buffer) const;

  [[nodiscard]] Vec<Dim> further_force(std::size_t i) const;
  [[nodiscard]] double inertia(std::size_t i) const;

  [[nodiscard]] std::vector<std::uint32_t> by_number() const;
  [[nodiscard]] double stored_in_guard() const;
  template <typename Visit>
  void for_boundary_pairs(const Visit& visit) const;
  [[nodiscard]] bool is_measured(std::size_t w) const;
  [[nodiscard]] double boundary_power(const std::vector<Wrench>& wrench) const;

  // What sweep 1 leaves for the sources; empty for the default operator.
  std::vector<typename Operator<Dim, Kernel>::Coefficients> coefficients_;

  Model<Dim, Kernel> model_;
  Parallel parallel_;
  Particles<Dim> fluid_;
  BodyImages images_;
  BoundaryParticles<Dim> boundary_;
  NeighborSearch<Dim> search_;
  Openings<Dim> openings_;
  bool by_groups_;
  Period period_;
  CloseList close_;
  MirrorGuard<Dim> mirror_guard_;
  Films<Dim> films_;
  FreeSurface<Dim> surface_;
  Shifting<Dim> shifting_;
  Crowding<Dim> crowding_;
  SurfaceTension<Dim> surface_tension_;
  BoundaryForces<Dim> boundary_forces_;
  BackgroundCells<Dim> background_cells_;
  std::vector<Kinematics> bodies_;
  std::vector<LaggedAcceleration> lagged_;  // per body
  std::vector<Reaction<Dim>> reaction_;     // on the active boundary particles, by particle
  std::vector<Wrench> wrench_;              // walls, then the bodies
  std::vector<Wrench> last_wrench_;         // of the step before
  bool measure_wall_force_;
  Weights weights_;
  bool tension_control_, is_symmetrized_, is_damped_, has_lumped_mass_;
  Integrator integrator_;
  double multistep_beta1_, multistep_beta2_;
  History<Dim> history_;
  double interpolated_motion_;
  bool initial_parameters_;
  std::vector<Vec<Dim>> interpolated_;  // v-hat [m/s]; empty where it is not used
  double courant_;
  double body_step_;  // [s]
  double boundary_work_ = 0;
  StageTimes times_;

  Checkpoint<std::vector<typename Operator<Dim, Kernel>::Coefficients>, Particles<Dim>,
             BoundaryParticles<Dim>, FreeSurface<Dim>, Shifting<Dim>, Crowding<Dim>, std::vector<Kinematics>,
             std::vector<LaggedAcceleration>, std::vector<Reaction<Dim>>, std::vector<Wrench>,
             std::vector<Wrench>, History<Dim>, std::vector<Vec<Dim>>, double, Openings<Dim>,
             SurfaceTension<Dim>>
      saved_;
  Checkpoint<NeighborSearch<Dim>> saved_search_;
  std::uint64_t saved_rebuilds_ = 0;
};

}  // namespace sluice::fluid
