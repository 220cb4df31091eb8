#pragma once

#include <vector>

#include "fluid/boundary.hpp"
#include "fluid/force_sweep.hpp"
#include "fluid/group_search.hpp"
#include "fluid/lanes.hpp"
#include "fluid/mirror_guard.hpp"
#include "fluid/parallel.hpp"

namespace sluice::fluid {

// Numbers of what is near a group.
struct NearBuffers {
  std::vector<std::uint32_t> fluid, boundary;

  static NearBuffers& of_thread() {
    thread_local NearBuffers buffers;
    return buffers;
  }
};

// The stages of a step that walk neighbours, on groups of particles: the default operator with Wendland's
// kernel, which is worth a vectorised version. Of the other stages and formulations see galerkin_stages.hpp.
template <int Dim>
class GroupStages {
 public:
  // What compute_gradients finds `close` is for compute_forces.
  GroupStages(const LaneModel<Dim>& model, const GroupSearch<Dim>& search, const Parallel& parallel,
              CloseList& close)
      : model_(model), search_(search), parallel_(parallel), close_(close) {}

  // boundary_velocity.hpp
  void mirror_velocities(const Particles<Dim>& fluid, BoundaryParticles<Dim>& boundary) const;
  // gradient_sweep.hpp
  void compute_gradients(const BoundaryParticles<Dim>& boundary, Particles<Dim>& fluid) const;
  // boundary_sweep.hpp, without viscous stress
  void extrapolate(const Particles<Dim>& fluid, BoundaryParticles<Dim>& boundary) const;
  // force_sweep.hpp: acceleration and density rate
  void compute_forces(const BoundaryParticles<Dim>& boundary, const MirrorGuard<Dim>& mirror_guard,
                      Particles<Dim>& fluid) const;
  // The force on the boundary particles of `groups`, by particle; without viscous stress.
  void react(const Particles<Dim>& fluid, const BoundaryParticles<Dim>& boundary,
             const std::vector<std::uint32_t>& groups, std::vector<Reaction<Dim>>& reaction) const;

 private:
  // Calls body(group, buffers).
  template <typename Body>
  void for_fluid_groups(std::size_t particles, const Body& body) const {
    parallel_.for_each(
        group_count(particles), [&](std::size_t group) { body(group, NearBuffers::of_thread()); },
        GroupList::kBlock);
  }
  // Calls body(group, what fluid is near it) for groups of boundary particles.
  template <typename Body>
  void for_boundary_groups(const std::vector<std::uint32_t>& groups, const Body& body) const {
    parallel_.for_each(
        groups.size(),
        [&](std::size_t a) {
          body(groups[a],
               unpack(search_.fluid_near_boundary().of(groups[a]), NearBuffers::of_thread().fluid));
        },
        GroupList::kBlock);
  }

  const LaneModel<Dim>& model_;
  const GroupSearch<Dim>& search_;
  const Parallel& parallel_;
  CloseList& close_;
};

extern template class GroupStages<2>;
extern template class GroupStages<3>;

}  // namespace sluice::fluid
