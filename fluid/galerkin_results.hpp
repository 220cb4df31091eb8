#pragma once

// What GalerkinSolver tells of its state.

#include "fluid/galerkin_solver.hpp"

namespace sluice::fluid {

template <int Dim, typename Kernel>
Snapshot GalerkinSolver<Dim, Kernel>::snapshot() const {
  Snapshot s;
  s.position.resize(3 * fluid_.size());
  s.velocity.resize(3 * fluid_.size());
  s.density.resize(fluid_.size());
  s.pressure.resize(fluid_.size());
  for (std::size_t k = 0; k < fluid_.size(); ++k) {
    const std::size_t i = fluid_.id[k];
    Eigen::Map<Eigen::Vector3d>(&s.position[3 * i]) = widen<Dim>(fluid_.node[k].x);
    Eigen::Map<Eigen::Vector3d>(&s.velocity[3 * i]) = widen<Dim>(fluid_.node[k].v);
    s.density[i] = fluid_.node[k].rho;
    s.pressure[i] = fluid_.pressure[k];
  }
  return s;
}

template <int Dim, typename Kernel>
Diagnostics GalerkinSolver<Dim, Kernel>::diagnostics() const {
  Diagnostics d;
  for (std::size_t i = 0; i < fluid_.size(); ++i) {
    const Node<Dim>& node = fluid_.node[i];
    const Eigen::Vector3d momentum = fluid_.mass[i] * widen<Dim>(node.v);
    d.kinetic += 0.5 * fluid_.mass[i] * node.v.squaredNorm();
    d.potential -= fluid_.mass[i] * model_.gravity.dot(node.x);
    d.elastic += fluid_.mass[i] * model_.eos.elastic_energy(node.rho);
    d.momentum += momentum;
    d.angular_momentum += widen<Dim>(node.x).cross(momentum);
    d.max_speed = larger(d.max_speed, node.v.norm());
    d.max_compression = larger(d.max_compression, std::abs(node.rho / model_.eos.rest_density() - 1.0));
  }
  d.elastic += stored_in_guard();
  d.boundary_work = boundary_work_;
  return d;
}

// Energy of the penetration guard [J].
template <int Dim, typename Kernel>
double GalerkinSolver<Dim, Kernel>::stored_in_guard() const {
  double energy = 0;
  const auto add = [&](std::size_t i, std::size_t w) {
    if (i < fluid_.size()) energy += guard_energy<Dim>(model_, fluid_.node[i].x - boundary_.node()[w].x);
  };
  if (by_groups_) {
    search_.groups().for_boundary_pairs(boundary_.size(), add);
    return energy;
  }
  const auto& active = search_.active_boundary();
  for (std::size_t a = 0; a < active.size(); ++a)
    for (const std::uint32_t i : search_.fluid_near_active(a)) add(i, active[a]);
  return energy;
}

}  // namespace sluice::fluid
