#pragma once

// The integrators of GalerkinSolver besides kick - drift - kick.

#include <limits>
#include <sstream>
#include <stdexcept>

#include "fluid/galerkin_solver.hpp"
#include "fluid/interpolation.hpp"
#include "fluid/multistep.hpp"

namespace sluice::fluid {

template <int Dim, typename Kernel>
void GalerkinSolver<Dim, Kernel>::start_history() {
  const std::size_t n = fluid_.size();
  if (integrator_ == Integrator::predictor_corrector) {
    history_.velocity.resize(n);
    history_.way.resize(n);
    history_.density.resize(n);
  }
  if (integrator_ != Integrator::multistep) return;
  history_.velocity.resize(n);
  history_.acceleration1.resize(n);
  for (std::size_t i = 0; i < n; ++i) history_.acceleration1[fluid_.id[i]] = fluid_.acceleration[i];
  history_.acceleration2 = history_.acceleration1;
}

// CF04 (37)-(39):
//   v^{k+1/2} = v^{k-1/2} + (dt_k + dt_{k+1})/2 a^k,   rho^{k+1} = rho^k + dt D(x^k, v^{k+1/2}),
//   x^{k+1} = x^k + dt v^{k+1/2}.
// Velocities are kept at whole steps, by two half kicks, which is the same. Against kick - drift - kick only
// the divergence differs, taken at the old positions. Cost: one more sweep 1, for the fits at the new ones.
template <int Dim, typename Kernel>
void GalerkinSolver<Dim, Kernel>::leap_frog(double dt, std::span<const Kinematics> bodies) {
  kick(0.5 * dt);
  search_.halo().refresh_nodes(fluid_);
  mirror_velocities();
  compute_gradients();
  advance_density(dt);
  move(dt, bodies);
  compute_gradients();
  evaluate();
  kick(0.5 * dt);
}

// CF (108)-(110): to the middle of the step with what is known at its start (P), from its start over the
// whole step with the forces at P; the divergence at the positions P with the velocity C, the mean of both
// ends. Deviation: the paper takes the forces of the last middle for those at the start; here they are
// computed, since the bodies ask for the forces at the end of every step. Cost: three sweeps 1, two sweeps 2.
template <int Dim, typename Kernel>
void GalerkinSolver<Dim, Kernel>::predictor_corrector(double dt, std::span<const Kinematics> bodies) {
  std::vector<Kinematics> middle;
  for (std::size_t b = 0; b < bodies.size(); ++b) middle.push_back(halfway(bodies_[b], bodies[b], dt));
  if (shifting_.is_used()) shifting_.apply(dt, fluid_, parallel_);
  parallel_.for_each(fluid_.size(), [&](std::size_t i) {
    history_.velocity[fluid_.id[i]] = fluid_.node[i].v;
    history_.density[fluid_.id[i]] = fluid_.node[i].rho;
    history_.way[fluid_.id[i]] = -fluid_.node[i].x;
  });
  advance_density(0.5 * dt);
  parallel_.for_each(fluid_.size(),
                     [&](std::size_t i) { history_.density[fluid_.id[i]] -= fluid_.node[i].rho; });
  update_volumes();
  drift(0.5 * dt);
  parallel_.for_each(fluid_.size(), [&](std::size_t i) { history_.way[fluid_.id[i]] += fluid_.node[i].x; });
  kick(0.5 * dt);
  place(0.5 * dt, middle);
  compute_gradients();
  evaluate_forces();
  update_volumes();
  parallel_.for_each(fluid_.size(), [&](std::size_t i) {
    fluid_.node[i].v = history_.velocity[fluid_.id[i]] + 0.5 * dt * fluid_.acceleration[i];
  });
  search_.halo().refresh_nodes(fluid_);
  mirror_velocities();
  compute_gradients();
  advance_density(dt);
  // What was added belongs to the density at the start, except in spray, which has been set.
  parallel_.for_each(fluid_.size(), [&](std::size_t i) {
    if (!fluid_.fit[i].floored) fluid_.node[i].rho += history_.density[fluid_.id[i]];
  });
  update_volumes();
  drift(dt);
  parallel_.for_each(fluid_.size(), [&](std::size_t i) {
    fluid_.node[i].x -= history_.way[fluid_.id[i]];
    fluid_.node[i].v = history_.velocity[fluid_.id[i]] + dt * fluid_.acceleration[i];
  });
  place(0.5 * dt, bodies);
  compute_gradients();
  evaluate();
}

// PC (26)-(27), see multistep.hpp; density with the divergence at the new positions and the mean velocity of
// the step, as in kick - drift - kick. Before the first step the acceleration counts as constant. Cost: that
// of kick - drift - kick, and two vectors a particle.
template <int Dim, typename Kernel>
void GalerkinSolver<Dim, Kernel>::multistep(double dt, std::span<const Kinematics> bodies) {
  parallel_.for_each(fluid_.size(), [&](std::size_t i) {
    const std::size_t id = fluid_.id[i];
    const Vec<Dim> a0 = fluid_.acceleration[i], v = fluid_.node[i].v;
    const Vec<Dim> D =
        multistep_difference<Vec<Dim>>(a0, history_.acceleration1[id], history_.acceleration2[id]);
    const Vec<Dim> mean = multistep_mean_velocity<Vec<Dim>>(v, a0, D, multistep_beta2_, dt);
    const Vec<Dim> next = multistep_velocity<Vec<Dim>>(v, a0, D, multistep_beta1_, dt);
    fluid_.node[i].v = mean;
    history_.velocity[id] = next - mean;
    history_.acceleration2[id] = history_.acceleration1[id];
    history_.acceleration1[id] = a0;
  });
  move(dt, bodies);
  compute_gradients();
  advance_density(dt);
  parallel_.for_each(fluid_.size(),
                     [&](std::size_t i) { fluid_.node[i].v += history_.velocity[fluid_.id[i]]; });
  search_.halo().refresh_nodes(fluid_);
  evaluate();
}

// v-hat of the present velocities at the present positions: with older ones the motion is unstable.
template <int Dim, typename Kernel>
void GalerkinSolver<Dim, Kernel>::interpolate_velocities() {
  if constexpr (Operator<Dim, Kernel>::kHasSumOne) {
    search_.halo().refresh_nodes(fluid_);
    mirror_velocities();
    interpolated_.resize(fluid_.size());
    parallel_.for_each(fluid_.size(), [&](std::size_t i) {
      VelocityInterpolation<Dim, Kernel> sweep(model_, fluid_.node[i]);
      sweep.gather(search_.fluid_near_fluid(i), fluid_.node);
      sweep.gather(search_.boundary_near_fluid(i), boundary_.node());
      interpolated_[i] = sweep.finish();
    });
  }
}

// CF (99): nodal parameters whose interpolated velocities are those given, by the iteration
// v += v-given - v-hat(v). It converges because the matrix of the N_j(x_i) smooths, slowly for what
// alternates between particles.
template <int Dim, typename Kernel>
void GalerkinSolver<Dim, Kernel>::find_initial_parameters() {
  constexpr int kMostSweeps = 1000;
  constexpr double kTolerance = 1e-6;  // of the largest speed
  std::vector<Vec<Dim>> given(fluid_.size());
  for (std::size_t i = 0; i < given.size(); ++i) given[i] = fluid_.node[i].v;
  const double scale = parallel_.max(given.size(), [&](std::size_t i) { return given[i].norm(); });
  double error = std::numeric_limits<double>::infinity();
  for (int sweep = 0; sweep < kMostSweeps; ++sweep) {
    interpolate_velocities();
    error = parallel_.max(given.size(), [&](std::size_t i) { return (given[i] - interpolated_[i]).norm(); });
    if (error <= kTolerance * scale) return;
    parallel_.for_each(given.size(), [&](std::size_t i) { fluid_.node[i].v += given[i] - interpolated_[i]; });
  }
  std::ostringstream text;
  text << "fluid setup: initial_parameters: the interpolated velocity still misses the given one by " << error
       << " m/s after " << kMostSweeps << " sweeps; it must come within " << kTolerance * scale
       << " m/s. Velocities that jump between particles need parameters far larger than themselves: leave "
          "initial_parameters out";
  throw std::invalid_argument(text.str());
}

template <int Dim, typename Kernel>
void GalerkinSolver<Dim, Kernel>::drift(double dt) {
  if (interpolated_motion_ > 0.0) {
    interpolate_velocities();
    parallel_.for_each(fluid_.size(), [&](std::size_t i) {
      Node<Dim>& node = fluid_.node[i];
      node.x += dt * (node.v + interpolated_motion_ * (interpolated_[i] - node.v));
    });
    return;
  }
  parallel_.for_each(fluid_.size(), [&](std::size_t i) { drift(i, dt); });
}

}  // namespace sluice::fluid
