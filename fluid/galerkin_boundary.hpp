#pragma once

// The stages of GalerkinSolver that are about the boundary particles.

#include "fluid/boundary_sweep.hpp"
#include "fluid/boundary_velocity.hpp"
#include "fluid/damped_viscosity.hpp"
#include "fluid/galerkin_solver.hpp"
#include "fluid/returned_force.hpp"
#include "fluid/symmetrized_force.hpp"

namespace sluice::fluid {

// Calls visit(w) for the boundary particles that have fluid near, or whose group has, in rising order.
template <int Dim, typename Kernel>
template <typename Visit>
void GalerkinSolver<Dim, Kernel>::for_active_boundary(const Visit& visit) const {
  if (!by_groups_) {
    for (const std::uint32_t w : search_.active_boundary()) visit(w);
    return;
  }
  for (const std::uint32_t group : search_.groups().active_boundary())
    for (std::size_t w = group * kGroup; w < std::min((group + 1) * kGroup, boundary_.size()); ++w) visit(w);
}

// Fluid near an active boundary particle, and some beyond the reach; `buffer` may hold it.
template <int Dim, typename Kernel>
std::span<const std::uint32_t> GalerkinSolver<Dim, Kernel>::fluid_near_boundary(
    std::size_t w, std::vector<std::uint32_t>& buffer) const {
  if (by_groups_) return search_.groups().fluid_near_boundary_particle(w, buffer);
  const auto& active = search_.active_boundary();
  const auto at = std::lower_bound(active.begin(), active.end(), w);
  return search_.fluid_near_active(static_cast<std::size_t>(at - active.begin()));
}

template <int Dim, typename Kernel>
void GalerkinSolver<Dim, Kernel>::mirror_velocities() {
  const Stopwatch watch(times_.boundary);
  if constexpr (kHasGroups)
    if (by_groups_) return group_stages().mirror_velocities(fluid_, boundary_);
  const auto& active = search_.active_boundary();
  parallel_.for_each(active.size(), [&](std::size_t a) {
    mirror_velocity<Dim>(model_, fluid_, search_.fluid_near_active(a), active[a], boundary_);
  });
}

template <int Dim, typename Kernel>
void GalerkinSolver<Dim, Kernel>::extrapolate_to_boundary() {
  const Stopwatch watch(times_.boundary);
  if constexpr (kHasGroups)
    if (by_groups_ && boundary_.stress.empty()) return group_stages().extrapolate(fluid_, boundary_);
  const auto& active = search_.active_boundary();
  parallel_.for_each(active.size(), [&](std::size_t a) {
    extrapolate<Dim>(model_, fluid_, search_.fluid_near_active(a), active[a], boundary_);
  });
}

// What boundary particles in an impact give back to the fluid; those of other operators, and of comparators
// that take the boundary's pressure for a node's, do not.
template <int Dim, typename Kernel>
void GalerkinSolver<Dim, Kernel>::return_forces() {
  if constexpr (Operator<Dim, Kernel>::kIsDefault) {
    if (is_symmetrized_ || background_cells_.is_used()) return;
    const Stopwatch watch(times_.boundary);
    std::vector<std::size_t> hit;
    for_active_boundary([&](std::size_t w) {
      if (boundary_.impact[w] > 0.0) hit.push_back(w);
    });
    boundary_.make_returning(hit);
    parallel_.for_each(hit.size(), [&](std::size_t k) {
      std::vector<std::uint32_t> buffer;
      boundary_.returned_force[k] =
          keep_work<Dim>(model_, fluid_, fluid_near_boundary(hit[k], buffer), hit[k], boundary_);
    });
  }
}

// The fluid's force on every measured boundary particle.
template <int Dim, typename Kernel>
void GalerkinSolver<Dim, Kernel>::compute_reactions() {
  reaction_.assign(boundary_.size(), {});
  if constexpr (kHasGroups)
    if (by_groups_ && boundary_.stress.empty())
      return group_stages().react(fluid_, boundary_, measured_groups(), reaction_);
  const auto& active = search_.active_boundary();
  parallel_.for_each(active.size(), [&](std::size_t a) {
    const std::size_t w = active[a];
    if (!is_measured(w)) return;
    const auto near = search_.fluid_near_active(a);
    reaction_[w] = reaction<Dim>(model_, fluid_, near, w, boundary_);
    if constexpr (Operator<Dim, Kernel>::kIsDefault)
      if (is_symmetrized_) add_symmetrized_reaction<Dim>(model_, fluid_, near, w, boundary_, reaction_[w]);
    if constexpr (HasLaplacian<Kernel, Dim>)
      if (is_damped_) add_damped_reaction<Dim>(model_, fluid_, near, boundary_.node()[w], reaction_[w]);
  });
}

template <int Dim, typename Kernel>
std::vector<std::uint32_t> GalerkinSolver<Dim, Kernel>::measured_groups() const {
  std::vector<std::uint32_t> groups;
  for_active_boundary([&](std::size_t w) {
    const auto group = static_cast<std::uint32_t>(w / kGroup);
    if ((groups.empty() || groups.back() != group) && is_measured(w)) groups.push_back(group);
  });
  return groups;
}

template <int Dim, typename Kernel>
void GalerkinSolver<Dim, Kernel>::collect_wrenches() {
  const Stopwatch watch(times_.reactions);
  wrench_.assign(wrench_.size(), Wrench{});
  if (bodies_.empty() && !measure_wall_force_) return;
  compute_reactions();
  if (surface_tension_.is_used()) surface_tension_.react(search_, boundary_, parallel_, fluid_, reaction_);
  if (background_cells_.is_used()) background_cells_.react(search_, boundary_, parallel_, fluid_, reaction_);
  if (boundary_forces_.is_used()) boundary_forces_.react(search_, boundary_, parallel_, fluid_, reaction_);
  for_active_boundary([&](std::size_t w) {
    if (!is_measured(w)) return;
    const auto body = static_cast<std::size_t>(boundary_.body(w));
    const Eigen::Vector3d center = body == 0 ? Eigen::Vector3d::Zero() : bodies_[body - 1].position;
    const Eigen::Vector3d arm = widen<Dim>(boundary_.node()[w].x) - center;
    const Eigen::Vector3d force = widen<Dim>(reaction_[w].force);
    wrench_[body].force += force;
    wrench_[body].moment += arm.cross(force) + reaction_[w].couple;
  });
  if (measure_wall_force_ && search_.halo().has_mirrors()) wrench_[0] = wrench_on_sides();
}

// Of a tank with mirrored sides, since the images' share has no boundary particle to act on: what accelerates
// the fluid besides gravity and the bodies, with the opposite sign.
template <int Dim, typename Kernel>
Wrench GalerkinSolver<Dim, Kernel>::wrench_on_sides() const {
  Wrench sum;
  for (std::size_t i = 0; i < fluid_.size(); ++i) {
    if (fluid_.is_buffer(i)) continue;
    const Eigen::Vector3d force =
        widen<Dim>(Vec<Dim>(fluid_.mass[i] * (model_.gravity - fluid_.acceleration[i])));
    sum.force += force;
    sum.moment += widen<Dim>(fluid_.node[i].x).cross(force);
  }
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    sum.force -= wrench_[b + 1].force;
    sum.moment -= wrench_[b + 1].moment + bodies_[b].position.cross(wrench_[b + 1].force);
  }
  return sum;
}

// The force of particles that were thrown back at a mirrored side in this step.
template <int Dim, typename Kernel>
void GalerkinSolver<Dim, Kernel>::add_impulse(double dt) {
  if (!measure_wall_force_) return;
  const Impulse impulse = search_.take_impulse();
  wrench_[0].force += impulse.linear / dt;
  wrench_[0].moment += impulse.angular / dt;
}

// Boundary particles of bodies always, but not of their images; of the walls on request, and those only once:
// not beyond a periodic side.
template <int Dim, typename Kernel>
bool GalerkinSolver<Dim, Kernel>::is_measured(std::size_t w) const {
  const auto body = static_cast<std::size_t>(boundary_.body(w));
  if (body > 0) return body <= bodies_.size();
  if (!measure_wall_force_ || search_.halo().has_mirrors()) return false;
  const Vec<Dim>& x = boundary_.node()[w].x;
  if (!openings_.is_inside(x)) return false;
  for (int a = 0; a < Dim; ++a)
    if (period_.length[a] > 0.0 && (x[a] < period_.lower[a] || x[a] >= period_.lower[a] + period_.length[a]))
      return false;
  return true;
}

// Power of the bodies on the fluid [W], from the wrenches at an end of the step and the velocities over it:
// the body moves by dt v under the mean of the two, which is what its own kinetic energy sees.
template <int Dim, typename Kernel>
double GalerkinSolver<Dim, Kernel>::boundary_power(const std::vector<Wrench>& wrench) const {
  double power = 0;
  for (std::size_t b = 0; b < bodies_.size(); ++b)
    power -=
        wrench[b + 1].force.dot(bodies_[b].velocity) + wrench[b + 1].moment.dot(bodies_[b].angular_velocity);
  return power;
}

template <int Dim, typename Kernel>
std::span<const Wrench> GalerkinSolver<Dim, Kernel>::wrenches() const {
  return std::span<const Wrench>(wrench_).subspan(1);
}

}  // namespace sluice::fluid
