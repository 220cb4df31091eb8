#pragma once

// The stages of GalerkinSolver. Included by one source file for each kernel, so that they compile side by
// side.

#include <cassert>

#include "fluid/galerkin_boundary.hpp"
#include "fluid/galerkin_forces.hpp"
#include "fluid/galerkin_gradients.hpp"
#include "fluid/galerkin_results.hpp"
#include "fluid/galerkin_rollback.hpp"
#include "fluid/galerkin_setup.hpp"
#include "fluid/galerkin_solver.hpp"
#include "fluid/integrators.hpp"

namespace sluice::fluid {

template <int Dim, typename Kernel>
void GalerkinSolver<Dim, Kernel>::start(std::span<const Kinematics> bodies) {
  move_boundary(0.0, bodies);
  openings_.fill(fluid_);
  find_neighbors();
  openings_.impose_velocity(0.0, fluid_, parallel_);
  openings_.impose_density(fluid_, parallel_);
  search_.halo().refresh_nodes(fluid_);
  mirror_velocities();
  // The boundary's density enters the gradients and needs the fluid's pressure: one sweep to fill it.
  compute_gradients();
  compute_stress();
  extrapolate_to_boundary();
  update_volumes();
  if (initial_parameters_) find_initial_parameters();
  search_.halo().refresh_nodes(fluid_);
  compute_gradients();
  evaluate();
  hold_openings(0.0);
  start_history();
}

template <int Dim, typename Kernel>
void GalerkinSolver<Dim, Kernel>::step(double dt, std::span<const Kinematics> bodies) {
  assert(dt > 0.0);
  const Stopwatch watch(times_.steps);
  last_wrench_ = wrench_;
  boundary_forces_.begin_step(dt);
  spread_crowds(dt);
  switch (integrator_) {
    case Integrator::kick_drift_kick:
      kick_drift_kick(dt, bodies);
      break;
    case Integrator::leap_frog:
      leap_frog(dt, bodies);
      break;
    case Integrator::predictor_corrector:
      predictor_corrector(dt, bodies);
      break;
    case Integrator::multistep:
      multistep(dt, bodies);
  }
  add_impulse(dt);
  boundary_work_ += 0.5 * dt * (boundary_power(last_wrench_) + boundary_power(wrench_));
}

// Kick - drift - kick. Positions of fluid and boundary are those of the end of the step when the velocity
// gradient is taken, with the velocity of its middle.
template <int Dim, typename Kernel>
void GalerkinSolver<Dim, Kernel>::kick_drift_kick(double dt, std::span<const Kinematics> bodies) {
  const std::size_t n = fluid_.size();
  std::optional<double> moved2;
  if (interpolated_motion_ > 0.0) {
    kick(0.5 * dt);
    drift(dt);
  } else {
    moved2 = parallel_.max(n, [&](std::size_t i) {
      kick(i, 0.5 * dt);
      drift(i, dt);
      return search_.moved2(fluid_, i);
    });
  }
  if (shifting_.is_used())
    shift_and_place(dt, bodies);
  else
    place(dt, bodies, moved2);
  compute_gradients();
  if (openings_.is_used()) return finish_with_openings(dt);
  parallel_.for_each(n, [&](std::size_t i) {
    advance_density(i, dt);
    set_stress(i);
  });
  complete_stress();
  compute_actions();
  take_reactions();
  parallel_.for_each(n, [&](std::size_t i) {
    update_volume(i);
    kick(i, 0.5 * dt);
  });
  update_boundary_volumes();
}

// The rest of the step where openings take a hand in what the passes above share.
template <int Dim, typename Kernel>
void GalerkinSolver<Dim, Kernel>::finish_with_openings(double dt) {
  advance_density(dt);
  openings_.impose_density(fluid_, parallel_);
  evaluate();
  hold_openings(dt);
  kick(0.5 * dt);
}

template <int Dim, typename Kernel>
void GalerkinSolver<Dim, Kernel>::move(double dt, std::span<const Kinematics> bodies) {
  drift(dt);
  shift_and_place(dt, bodies);
}

template <int Dim, typename Kernel>
void GalerkinSolver<Dim, Kernel>::shift_and_place(double dt, std::span<const Kinematics> bodies) {
  if (shifting_.is_used()) shifting_.apply(dt, fluid_, parallel_);
  place(dt, bodies);
}

template <int Dim, typename Kernel>
void GalerkinSolver<Dim, Kernel>::place(double dt, std::span<const Kinematics> bodies,
                                        std::optional<double> moved2) {
  move_boundary(dt, bodies);
  openings_.advance(dt);
  find_neighbors(moved2);
  openings_.impose_velocity(dt, fluid_, parallel_);
  search_.halo().refresh_nodes(fluid_);
  mirror_velocities();
}

template <int Dim, typename Kernel>
void GalerkinSolver<Dim, Kernel>::find_neighbors(std::optional<double> moved2) {
  const Stopwatch watch(times_.search);
  if (!moved2) moved2 = search_.moved2(fluid_, parallel_);
  if (!search_.is_stale(*moved2, boundary_)) return;
  openings_.exchange(fluid_);
  search_.rebuild(fluid_, boundary_, parallel_);
  if (openings_.is_used()) openings_.list(fluid_);
}

template <int Dim, typename Kernel>
void GalerkinSolver<Dim, Kernel>::kick(double dt) {
  parallel_.for_each(fluid_.size(), [&](std::size_t i) { kick(i, dt); });
}

template <int Dim, typename Kernel>
void GalerkinSolver<Dim, Kernel>::move_boundary(double dt, std::span<const Kinematics> bodies) {
  bodies_.assign(bodies.begin(), bodies.end());
  for (std::size_t b = 0; b < bodies_.size(); ++b) lagged_[b].replace(bodies_[b], dt);
  boundary_.move(images_.with_images(bodies_));
}

template <int Dim, typename Kernel>
void GalerkinSolver<Dim, Kernel>::spread_crowds(double dt) {
  if (!crowding_.is_used() || !crowding_.is_due(dt)) return;
  search_.halo().refresh_nodes(fluid_);
  const auto fluid_near = [this](std::size_t i, const auto& visit) { for_fluid_near(i, visit); };
  crowding_.spread(model_, fluid_near, parallel_, fluid_);
}

template <int Dim, typename Kernel>
template <typename Visit>
void GalerkinSolver<Dim, Kernel>::for_fluid_near(std::size_t i, const Visit& visit) const {
  if (by_groups_)
    search_.groups().for_fluid_near_particle(i, visit);
  else
    for (const std::uint32_t k : search_.fluid_near_fluid(i)) visit(k);
}

// Buffers move as they are told; what they do to the fluid is counted. Of the energy of the fluid i they
// change
//   sum_ib V_b W (s_i + S_i x_bi) . v_b - V_i W (s_b + S_b x_ib) . v_i
// since in sum_i f_i . v_i and in the stress power of all particles the same terms stand (force_sweep.hpp).
template <int Dim, typename Kernel>
void GalerkinSolver<Dim, Kernel>::hold_openings(double dt) {
  if (!openings_.is_used()) return;
  using Rule = Operator<Dim, Kernel>;
  double power = 0;
  openings_.for_pairs([&](std::size_t b, std::size_t i) {
    const Node<Dim>&buffer = fluid_.node[b], &node = fluid_.node[i];
    const Vec<Dim> x_bi = buffer.x - node.x;
    const ValueAndSlope weight = model_.kernel.value_and_slope(x_bi);
    power += buffer.volume * Rule::flux(fluid_, i, weight, x_bi).dot(buffer.v) -
             node.volume * Rule::flux(fluid_, b, weight, -x_bi).dot(node.v);
  });
  openings_.stop_acceleration(fluid_, parallel_);
  openings_.count_work(dt, power);
}

}  // namespace sluice::fluid
