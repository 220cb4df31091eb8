#pragma once

// The stages of GalerkinSolver. Included by one source file for each kernel, so that they compile side by
// side.

#include <cassert>
#include <numeric>

#include "fluid/damped_viscosity.hpp"
#include "fluid/galerkin_boundary.hpp"
#include "fluid/galerkin_liquids.hpp"
#include "fluid/galerkin_results.hpp"
#include "fluid/galerkin_rollback.hpp"
#include "fluid/galerkin_solver.hpp"
#include "fluid/gradient_sweep.hpp"
#include "fluid/integrators.hpp"
#include "fluid/lumped_mass.hpp"
#include "fluid/no_slip.hpp"
#include "fluid/operator_sweep.hpp"
#include "fluid/stress.hpp"
#include "fluid/stress_points.hpp"
#include "fluid/symmetrized_force.hpp"
#include "fluid/tension_control.hpp"
#include "fluid/wedged.hpp"

namespace sluice::fluid {

namespace stages {

// Neighbour lists reach this share of the support beyond it: the optimum between longer lists and rarer
// rebuilds was flat between 0.1 and 0.2 in a developed dam break.
inline constexpr double kSkin = 0.1;

// Whether the sweeps go by groups of particles (group_stages.hpp) and not by single ones.
template <int Dim, typename Kernel>
bool goes_by_groups(const Setup& setup) {
  const Formulation& formulation = setup.formulation;
  return GalerkinSolver<Dim, Kernel>::kHasGroups && formulation.internal_force == InternalForce::galerkin &&
         formulation.viscous_force == ViscousForce::stress && formulation.mass == Mass::physical &&
         formulation.interpolated_motion == 0.0 && !formulation.initial_parameters &&
         !formulation.tension_control && setup.liquids.empty();
}

template <int Dim, typename Kernel>
SearchPlan search_plan(const Setup& setup) {
  const bool groups = goes_by_groups<Dim, Kernel>(setup);
  const bool singles = !groups || setup.formulation.shifting > 0.0 || setup.liquid.surface_tension > 0.0;
  return {.singles = singles,
          .wall_singles = singles || setup.has_viscous_stress(),
          .groups = groups,
          .cell = group_edge<Dim>(setup.spacing)};
}

template <int Dim>
Particles<Dim> make_particles(const Setup& setup, const EquationOfState& eos) {
  const FluidParticles& given = setup.fluid;
  const std::size_t n = given.position.size();
  Particles<Dim> fluid;
  fluid.mass.resize(n);
  fluid.node.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double rho = eos.density(given.pressure[i]);
    fluid.mass[i] = rho * given.volume;
    fluid.node[i] = {narrow<Dim>(given.position[i]), narrow<Dim>(given.velocity[i]), given.volume, rho};
  }
  fluid.liquid = given.liquid;
  fluid.liquids = liquid_constants(setup);
  if (fluid.has_several_liquids()) {
    fluid.own.resize(n);
    for (std::size_t i = 0; i < n; ++i) fluid.mass[i] *= fluid.relative_density(i);
  }
  fluid.id.resize(n);
  std::iota(fluid.id.begin(), fluid.id.end(), 0u);
  fluid.acceleration.assign(n, Vec<Dim>::Zero());
  fluid.density_rate.assign(n, 0.0);
  fluid.pressure.assign(n, 0.0);
  fluid.divergence.assign(n, 0.0);
  if (setup.formulation.shifting > 0.0) fluid.L.assign(n, Mat<Dim>::Zero());
  if (setup.has_viscous_stress()) fluid.stress.assign(n, Mat<Dim>::Zero());
  fluid.fit.resize(n);
  fluid.source.resize(n);
  if (setup.formulation.approximation == Approximation::mls_full_derivative) fluid.slope_source.resize(n);
  if (setup.formulation.quadrature == Quadrature::stress_points)
    fluid.point_source.resize(Particles<Dim>::kPoints * n);
  return fluid;
}

template <int Dim, typename Kernel>
std::vector<LaggedAcceleration> make_lagged(const Setup& setup, const Model<Dim, Kernel>& model) {
  std::vector<LaggedAcceleration> lagged;
  for (const Boundary& body : setup.bodies)
    lagged.emplace_back(body.free_mass > 0.0, model.h / model.eos.sound_speed());
  return lagged;
}

}  // namespace stages

template <int Dim, typename Kernel>
GalerkinSolver<Dim, Kernel>::GalerkinSolver(const Setup& setup)
    : model_(setup),
      parallel_(setup.threads),
      fluid_(stages::make_particles<Dim>(setup, model_.eos)),
      images_(setup),
      boundary_(setup, images_.with_images(setup.bodies)),
      search_(model_.kernel.support() + model_.extra_reach, stages::kSkin * model_.kernel.support(),
              setup.period, stages::search_plan<Dim, Kernel>(setup), setup.mirrors),
      openings_(setup, model_.kernel.support() + model_.extra_reach, stages::kSkin * model_.kernel.support()),
      by_groups_(stages::goes_by_groups<Dim, Kernel>(setup)),
      period_(setup.period),
      mirror_guard_(setup.mirrors, model_),
      shifting_(setup.formulation.shifting),
      crowding_(setup.formulation.spreading, setup.gravity.norm(), model_),
      surface_tension_(setup, model_.kernel.support()),
      bodies_(setup.bodies.size()),
      lagged_(stages::make_lagged(setup, model_)),
      wrench_(setup.bodies.size() + 1),
      measure_wall_force_(setup.measure_wall_force),
      weights_(setup.formulation.weights),
      tension_control_(setup.formulation.tension_control),
      is_symmetrized_(setup.formulation.internal_force == InternalForce::symmetrized),
      is_damped_(setup.formulation.viscous_force == ViscousForce::damped),
      has_lumped_mass_(setup.formulation.mass == Mass::lumped),
      integrator_(setup.formulation.integrator),
      multistep_beta1_(setup.formulation.multistep_beta1),
      multistep_beta2_(setup.formulation.multistep_beta2),
      interpolated_motion_(setup.formulation.interpolated_motion),
      initial_parameters_(setup.formulation.initial_parameters),
      courant_(setup.formulation.courant),
      body_step_(setup.limit_step_by_bodies ? largest_body_step(setup)
                                            : std::numeric_limits<double>::infinity()) {}

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
  last_wrench_ = wrench_;
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
  kick(0.5 * dt);
  move(dt, bodies);
  compute_gradients();
  advance_density(dt);
  openings_.impose_density(fluid_, parallel_);
  evaluate();
  hold_openings(dt);
  kick(0.5 * dt);
}

template <int Dim, typename Kernel>
void GalerkinSolver<Dim, Kernel>::move(double dt, std::span<const Kinematics> bodies) {
  drift(dt);
  if (shifting_.is_used()) shifting_.apply(dt, fluid_, parallel_);
  place(dt, bodies);
}

template <int Dim, typename Kernel>
void GalerkinSolver<Dim, Kernel>::place(double dt, std::span<const Kinematics> bodies) {
  move_boundary(dt, bodies);
  openings_.advance(dt);
  find_neighbors();
  openings_.impose_velocity(dt, fluid_, parallel_);
  search_.halo().refresh_nodes(fluid_);
  mirror_velocities();
}

template <int Dim, typename Kernel>
void GalerkinSolver<Dim, Kernel>::find_neighbors() {
  if (!search_.is_stale(fluid_, boundary_, parallel_)) return;
  openings_.exchange(fluid_);
  search_.rebuild(fluid_, boundary_, parallel_);
  if (openings_.is_used()) openings_.list(fluid_);
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

template <int Dim, typename Kernel>
void GalerkinSolver<Dim, Kernel>::evaluate_forces() {
  compute_stress();
  extrapolate_to_boundary();
  if (tension_control_ || shifting_.is_used()) surface_.detect(model_, fluid_, parallel_);
  compute_forces();
}

template <int Dim, typename Kernel>
void GalerkinSolver<Dim, Kernel>::evaluate() {
  evaluate_forces();
  collect_wrenches();
  if (shifting_.is_used()) shifting_.compute(model_, fluid_, boundary_, search_, surface_, parallel_);
  update_volumes();
}

template <int Dim, typename Kernel>
void GalerkinSolver<Dim, Kernel>::kick(double dt) {
  parallel_.for_each(fluid_.size(), [&](std::size_t i) { fluid_.node[i].v += dt * fluid_.acceleration[i]; });
}

template <int Dim, typename Kernel>
void GalerkinSolver<Dim, Kernel>::move_boundary(double dt, std::span<const Kinematics> bodies) {
  bodies_.assign(bodies.begin(), bodies.end());
  for (std::size_t b = 0; b < bodies_.size(); ++b) lagged_[b].replace(bodies_[b], dt);
  boundary_.move(images_.with_images(bodies_));
}

// Sweep 1.
template <int Dim, typename Kernel>
void GalerkinSolver<Dim, Kernel>::compute_gradients() {
  if constexpr (kHasGroups)
    if (by_groups_) group_stages().compute_gradients(boundary_, fluid_);
  if (!by_groups_) compute_single_gradients();
  if (fluid_.has_several_liquids()) separate_liquids();
  // Corrected SPH threw a single particle of a splash out by it.
  if (Operator<Dim, Kernel>::kIsDefault && !bodies_.empty()) find_films();
  if (!boundary_.sticks()) return;
  parallel_.for_each(fluid_.size(), [&](std::size_t i) {
    fluid_.source[i].strain +=
        sticking_strain<Dim>(model_, fluid_, i, search_.boundary_near_fluid(i), boundary_);
  });
}

template <int Dim, typename Kernel>
void GalerkinSolver<Dim, Kernel>::compute_single_gradients() {
  if constexpr (!Operator<Dim, Kernel>::kIsDefault) coefficients_.resize(fluid_.size());
  parallel_.for_each(fluid_.size(), [&](std::size_t i) {
    FirstSweep<Dim, Kernel> sweep(model_, fluid_.node[i]);
    sweep.gather(search_.fluid_near_fluid(i), fluid_.node);
    sweep.gather(search_.boundary_near_fluid(i), boundary_.node());
    const auto gradients = sweep.finish();
    if constexpr (!Operator<Dim, Kernel>::kIsDefault) coefficients_[i] = gradients.coefficients;
    fluid_.fit[i] = gradients.fit;
    fluid_.source[i].grad_rho = gradients.grad_rho;
    fluid_.divergence[i] = gradients.L.trace();
    fluid_.source[i].strain = strain_rate<Dim>(gradients.L);
    if (shifting_.is_used()) fluid_.L[i] = gradients.L;
  });
}

// Fluid that is caught between two surfaces, or was pressed through one, counts as spray and carries no
// pressure at all (wedged.hpp): it would be that of one particle between stiff walls, whose forces do not
// match the work done on it. With it, heavy bodies that come down on a floor bring several times their energy
// in.
template <int Dim, typename Kernel>
void GalerkinSolver<Dim, Kernel>::find_films() {
  parallel_.for_each(fluid_.size(), [&](std::size_t i) {
    thread_local std::vector<std::uint32_t> buffer;
    const auto near =
        by_groups_ ? search_.groups().boundary_near_particle(i, buffer) : search_.boundary_near_fluid(i);
    const Vec<Dim>& x = fluid_.node[i].x;
    if (near.empty() || !(is_wedged<Dim>(model_, x, near, boundary_, mirror_guard_.planes()) ||
                          is_inside_boundary<Dim>(x, near, boundary_)))
      return;
    fluid_.fit[i].floored = true;
    fluid_.node[i].rho = model_.eos.rest_density();
    fluid_.divergence[i] = fluid_.density_rate[i] = 0.0;
  });
}

template <int Dim, typename Kernel>
void GalerkinSolver<Dim, Kernel>::spread_crowds(double dt) {
  if (!crowding_.is_used() || !crowding_.is_due(dt)) return;
  search_.halo().refresh_nodes(fluid_);
  const auto for_fluid_near = [this](std::size_t i, const auto& visit) {
    if (by_groups_)
      search_.groups().for_fluid_near_particle(i, visit);
    else
      for (const std::uint32_t k : search_.fluid_near_fluid(i)) visit(k);
  };
  crowding_.spread(model_, for_fluid_near, parallel_, fluid_);
}

// CF (70) with the divergence at the new positions, and the density diffusion of the last sweep 2. A particle
// with too few neighbours for a fit is spray: it carries no tension, and its pressure falls to the ambient
// one in the time that sound takes across it, since its own divergence hardly feels it. Nor is there tension
// between a particle and a mirror (mirror_guard.hpp).
template <int Dim, typename Kernel>
void GalerkinSolver<Dim, Kernel>::advance_density(double dt) {
  const double rho0 = model_.eos.rest_density();
  const double acoustic_time = model_.h / model_.eos.sound_speed();
  parallel_.for_each(fluid_.size(), [&](std::size_t i) {
    double& rho = fluid_.node[i].rho;
    rho += dt * (fluid_.density_rate[i] - rho * fluid_.divergence[i]);
    if (rho < rho0 && mirror_guard_.is_film(fluid_.node[i].x)) rho = rho0;
    if (fluid_.fit[i].floored) rho = rho0 + std::max(0.0, rho - rho0) / (1.0 + dt / acoustic_time);
  });
}

// V_k of the quadrature. Node::volume weighs the neighbours in the moments, CF (11), and is the same then;
// with weights CF (12) that stays what it was at the start.
template <int Dim, typename Kernel>
double GalerkinSolver<Dim, Kernel>::quadrature_volume(std::size_t i) const {
  const Node<Dim>& node = fluid_.node[i];
  return weights_ == Weights::kernel ? fluid_.mass[i] / node.rho : node.volume;
}

// CF (60), (64). The volumes stay those of sweep 1, so that sum grad N = 0 holds for the forces too.
template <int Dim, typename Kernel>
void GalerkinSolver<Dim, Kernel>::compute_stress() {
  using Rule = Operator<Dim, Kernel>;
  parallel_.for_each(fluid_.size(), [&](std::size_t i) {
    fluid_.pressure[i] = model_.eos.pressure(fluid_.node[i].rho);
    Mat<Dim> sigma = -fluid_.pressure[i] * Mat<Dim>::Identity();
    if constexpr (Rule::kIsIsobaric) sigma.setZero();
    if (!fluid_.stress.empty() && !fluid_.has_several_liquids()) {
      // Where G is not the exact inverse, a shear stress would exert a moment: spray has none.
      fluid_.stress[i] =
          fluid_.fit[i].floored ? Mat<Dim>::Zero() : viscous_stress<Dim>(model_.mu, fluid_.source[i].strain);
      sigma += fluid_.stress[i];
    }
    if constexpr (Rule::kIsDefault)
      set_source<Dim>(quadrature_volume(i), sigma, fluid_.fit[i], fluid_.source[i]);
    else if constexpr (Rule::kHasPoints)
      Rule::set_source(model_.eos, quadrature_volume(i), sigma, coefficients_[i], fluid_, i);
    else
      Rule::set_source(quadrature_volume(i), sigma, coefficients_[i], fluid_, i);
  });
  if (fluid_.has_several_liquids() && !fluid_.stress.empty()) compute_own_stress();
  if (surface_tension_.is_used()) surface_tension_.compute(search_, boundary_, parallel_, fluid_);
  search_.halo().refresh_sources(fluid_);
}

// Sweep 2.
template <int Dim, typename Kernel>
void GalerkinSolver<Dim, Kernel>::compute_forces() {
  if constexpr (kHasGroups)
    if (by_groups_) group_stages().compute_forces(boundary_, fluid_);
  if (!by_groups_) compute_single_forces();
  mirror_guard_.accelerate(parallel_, fluid_);
  if (surface_tension_.is_used()) surface_tension_.accelerate(parallel_, fluid_);
}

template <int Dim, typename Kernel>
void GalerkinSolver<Dim, Kernel>::compute_single_forces() {
  if (fluid_.has_several_liquids()) return compute_liquid_forces();
  parallel_.for_each(fluid_.size(), [&](std::size_t i) {
    ForceSweep<Dim, Kernel> sweep(model_, fluid_, i);
    sweep.gather_fluid(search_.fluid_near_fluid(i));
    sweep.gather_boundary(search_.boundary_near_fluid(i), boundary_);
    Vec<Dim> force = sweep.force();
    if (tension_control_) force += tension_correction(model_, fluid_, boundary_, search_, surface_, i);
    if (is_symmetrized_ || is_damped_) force += further_force(i);
    fluid_.acceleration[i] = model_.gravity + force / inertia(i);
    fluid_.density_rate[i] = sweep.density_rate();
  });
}

// Of the formulations that have sweeps of their own.
template <int Dim, typename Kernel>
Vec<Dim> GalerkinSolver<Dim, Kernel>::further_force(std::size_t i) const {
  Vec<Dim> force = Vec<Dim>::Zero();
  if constexpr (Operator<Dim, Kernel>::kIsDefault)
    if (is_symmetrized_) force += symmetrized_extra<Dim>(model_, fluid_, boundary_, search_, i);
  if constexpr (HasLaplacian<Kernel, Dim>)
    if (is_damped_) force += damped_force<Dim>(model_, fluid_, boundary_, search_, i);
  return force;
}

// What the force on a particle is divided by [kg].
template <int Dim, typename Kernel>
double GalerkinSolver<Dim, Kernel>::inertia(std::size_t i) const {
  if constexpr (Operator<Dim, Kernel>::kHasSumOne)
    if (has_lumped_mass_) return lumped_mass<Dim>(model_, fluid_, boundary_, search_, i);
  return fluid_.mass[i];
}

// V = m/rho, for the next step: until here sweep 2 needed the volumes of sweep 1.
template <int Dim, typename Kernel>
void GalerkinSolver<Dim, Kernel>::update_volumes() {
  if (fluid_.has_several_liquids())
    parallel_.for_each(fluid_.size(), [&](std::size_t i) {
      fluid_.node[i].volume = fluid_.mass[i] / (fluid_.node[i].rho * fluid_.relative_density(i));
    });
  else if (weights_ == Weights::kernel_and_volume)
    parallel_.for_each(fluid_.size(),
                       [&](std::size_t i) { fluid_.node[i].volume = fluid_.mass[i] / fluid_.node[i].rho; });
  for_active_boundary([&](std::size_t w) {
    boundary_.node()[w].volume = boundary_.sampled_volume(w) * boundary_.dilation[w];
  });
}

template <int Dim, typename Kernel>
double GalerkinSolver<Dim, Kernel>::largest_step(double max_speed) const {
  double sound_speed = model_.eos.sound_speed();
  double viscosity = model_.artificial_viscosity / model_.eos.rest_density();  // kinematic
  for (const LiquidConstants& liquid : fluid_.liquids) {
    sound_speed = std::max(sound_speed, model_.eos.sound_speed() / std::sqrt(liquid.relative_density));
    // The mean friction is up to twice the smaller one.
    viscosity = std::max(viscosity, (liquid.pair_viscosity + liquid.friction) /
                                        (liquid.relative_density * model_.eos.rest_density()));
  }
  const double acoustic = model_.h / (sound_speed + max_speed);
  const double viscous = model_.h * model_.h / (viscosity + 1e-300);
  return std::min({courant_ * std::min(acoustic, viscous), body_step_, surface_tension_.largest_step()});
}

}  // namespace sluice::fluid
