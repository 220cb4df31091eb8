#pragma once

// What GalerkinSolver tells of its state.

#include <algorithm>

#include "fluid/force_parts.hpp"
#include "fluid/galerkin_solver.hpp"

namespace sluice::fluid {

// The particles in the tank, by rising number.
template <int Dim, typename Kernel>
std::vector<std::uint32_t> GalerkinSolver<Dim, Kernel>::by_number() const {
  std::vector<std::uint32_t> order;
  if (!openings_.is_used()) {
    order.resize(fluid_.size());
    for (std::uint32_t k = 0; k < order.size(); ++k) order[fluid_.id[k]] = k;
    return order;
  }
  for (std::uint32_t k = 0; k < fluid_.size(); ++k)
    if (!fluid_.is_buffer(k)) order.push_back(k);
  std::sort(order.begin(), order.end(),
            [this](std::uint32_t a, std::uint32_t b) { return fluid_.id[a] < fluid_.id[b]; });
  return order;
}

template <int Dim, typename Kernel>
Snapshot GalerkinSolver<Dim, Kernel>::snapshot() const {
  Snapshot s;
  const std::vector<std::uint32_t> order = by_number();
  const std::size_t n = order.size();
  s.position.resize(3 * n);
  s.velocity.resize(3 * n);
  s.density.resize(n);
  s.pressure.resize(n);
  s.id.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const std::uint32_t k = order[i];
    s.id[i] = fluid_.id[k];
    Eigen::Map<Eigen::Vector3d>(&s.position[3 * i]) = widen<Dim>(fluid_.node[k].x);
    Eigen::Map<Eigen::Vector3d>(&s.velocity[3 * i]) = widen<Dim>(fluid_.node[k].v);
    s.density[i] = fluid_.node[k].rho;
    s.pressure[i] = fluid_.pressure[k];
  }
  if (!fluid_.has_several_liquids()) return s;
  for (std::size_t i = 0; i < n; ++i) {
    s.liquid.push_back(fluid_.liquid[order[i]]);
    s.density[i] *= fluid_.relative_density(order[i]);
  }
  return s;
}

template <int Dim, typename Kernel>
Diagnostics GalerkinSolver<Dim, Kernel>::diagnostics() const {
  Diagnostics d;
  for (std::size_t i = 0; i < fluid_.size(); ++i) {
    if (fluid_.is_buffer(i)) continue;
    d.mass += fluid_.mass[i];
    const Node<Dim>& node = fluid_.node[i];
    const Eigen::Vector3d momentum = fluid_.mass[i] * widen<Dim>(node.v);
    d.kinetic += 0.5 * fluid_.mass[i] * node.v.squaredNorm();
    d.potential -= fluid_.mass[i] * model_.gravity.dot(node.x);
    d.elastic += fluid_.mass[i] / fluid_.relative_density(i) * model_.eos.elastic_energy(node.rho);
    d.momentum += momentum;
    d.angular_momentum += widen<Dim>(node.x).cross(momentum);
    d.max_speed = larger(d.max_speed, node.v.norm());
    d.max_compression = larger(d.max_compression, std::abs(node.rho / model_.eos.rest_density() - 1.0));
  }
  d.surface = surface_tension_.energy();
  d.elastic += stored_in_guard() + d.surface;
  d.boundary_work = boundary_work_ + openings_.work();
  if (openings_.is_used()) d.openings = openings_.passages(fluid_);
  return d;
}

template <int Dim, typename Kernel>
std::vector<WrenchParts> GalerkinSolver<Dim, Kernel>::wrench_parts() const {
  std::vector<WrenchParts> parts(wrench_.size() - 1);
  const auto add = [&](std::size_t i, std::size_t w) {
    if (boundary_.body(w) == 0) return;
    const auto b = static_cast<std::size_t>(boundary_.body(w) - 1);
    if (b >= parts.size()) return;  // an image's
    const ReactionParts<Dim> pair = reaction_parts<Dim>(model_, fluid_, i, w, boundary_);
    const Eigen::Vector3d arm = widen<Dim>(boundary_.node()[w].x) - bodies_[b].position;
    const Eigen::Vector3d guard = widen<Dim>(pair.guard), viscous = widen<Dim>(pair.viscous.force);
    parts[b].guard.force += guard;
    parts[b].guard.moment += arm.cross(guard);
    parts[b].viscous.force += viscous;
    parts[b].viscous.moment += arm.cross(viscous) + pair.viscous.couple;
  };
  for_boundary_pairs(add);
  for (std::size_t b = 0; b < parts.size(); ++b) {
    const Wrench& all = wrench_[b + 1];
    parts[b].pressure.force = all.force - parts[b].guard.force - parts[b].viscous.force;
    parts[b].pressure.moment = all.moment - parts[b].guard.moment - parts[b].viscous.moment;
  }
  return parts;
}

// Calls visit(i, w) for every fluid particle, images included, near a boundary particle; maybe for some that
// are a little farther than the support.
template <int Dim, typename Kernel>
template <typename Visit>
void GalerkinSolver<Dim, Kernel>::for_boundary_pairs(const Visit& visit) const {
  if (by_groups_) {
    search_.groups().for_boundary_pairs(boundary_.size(), visit);
    return;
  }
  const auto& active = search_.active_boundary();
  for (std::size_t a = 0; a < active.size(); ++a)
    for (const std::uint32_t i : search_.fluid_near_active(a)) visit(i, active[a]);
}

// Energy of the penetration guard [J].
template <int Dim, typename Kernel>
double GalerkinSolver<Dim, Kernel>::stored_in_guard() const {
  double energy = 0;
  for_boundary_pairs([&](std::size_t i, std::size_t w) {
    if (i < fluid_.size() && !fluid_.is_buffer(i))
      energy += guard_energy<Dim>(model_, fluid_.node[i].x - boundary_.node()[w].x);
  });
  return energy + mirror_guard_.energy(fluid_);
}

}  // namespace sluice::fluid
