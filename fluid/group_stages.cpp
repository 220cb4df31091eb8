#include "fluid/group_stages.hpp"

#include "fluid/boundary_sweep.hpp"
#include "fluid/boundary_velocity.hpp"
#include "fluid/stress.hpp"

namespace sluice::fluid {

namespace {

std::size_t group_end(std::size_t group, std::size_t count) {
  return std::min((group + 1) * kGroup, count);
}

template <int Dim>
Vec<Dim> vec_at(const LaneVec<Dim>& lanes, std::size_t l) {
  Vec<Dim> v;
  for (int a = 0; a < Dim; ++a) v[a] = lanes[static_cast<std::size_t>(a)][l];
  return v;
}
template <int Dim>
Mat<Dim> mat_at(const LaneMat<Dim>& lanes, std::size_t l) {
  Mat<Dim> m;
  for (int a = 0; a < Dim; ++a)
    for (int b = 0; b < Dim; ++b) m(a, b) = lanes[static_cast<std::size_t>(a * Dim + b)][l];
  return m;
}
template <int Dim>
Mat<Dim> sym_at(const LaneSym<Dim>& lanes, std::size_t l) {
  Mat<Dim> m;
  std::size_t k = 0;
  for (int a = 0; a < Dim; ++a)
    for (int b = a; b < Dim; ++b) m(a, b) = m(b, a) = lanes[k++][l];
  return m;
}
// Entry by entry into place: a matrix that is returned is written by entries and read by pairs of them at
// once, which stalls.
template <int Dim>
void take(const LaneVec<Dim>& lanes, std::size_t l, Vec<Dim>& v) {
  for (int a = 0; a < Dim; ++a) v[a] = lanes[static_cast<std::size_t>(a)][l];
}
template <int Dim>
void take(const LaneSym<Dim>& lanes, std::size_t l, Symmetric<Dim>& m) {
  for (std::size_t k = 0; k < Symmetric<Dim>::kEntries; ++k) m[k] = lanes[k][l];
}
template <int Dim>
void put(const Vec<Dim>& v, std::size_t l, LaneVec<Dim>& lanes) {
  for (int a = 0; a < Dim; ++a) lanes[static_cast<std::size_t>(a)][l] = v[a];
}

// Velocities of the bodies; the lanes behind the last particle get any.
template <int Dim>
void put_body_velocities(const BoundaryParticles<Dim>& boundary, std::size_t group, LaneVec<Dim>& lanes) {
  for (std::size_t l = 0; l < kGroup; ++l)
    put<Dim>(boundary.velocity(std::min(group * kGroup + l, boundary.size() - 1)), l, lanes);
}

}  // namespace

template <int Dim>
void GroupStages<Dim>::mirror_velocities(const Particles<Dim>& fluid,
                                         BoundaryParticles<Dim>& boundary) const {
  for_boundary_groups(search_.active_boundary(), [&](std::size_t group, const NearGroup& near) {
    FlowLanes<Dim> flow;
    put_body_velocities<Dim>(boundary, group, flow.body_velocity);
    gather_flow<Dim>(model_, node_lanes(boundary.node(), boundary.size(), group), {near, fluid.node.data()},
                     flow);
    for (std::size_t w = group * kGroup; w < group_end(group, boundary.size()); ++w) {
      const std::size_t l = w % kGroup;
      const Moments<Dim> moments{flow.m0[l], vec_at<Dim>(flow.m1, l), sym_at<Dim>(flow.m2, l)};
      mirror_flow(model_, Extrapolation<Dim, Dim>(moments, vec_at<Dim>(flow.v, l), mat_at<Dim>(flow.vx, l)),
                  w, boundary);
    }
  });
}

template <int Dim>
void GroupStages<Dim>::compute_gradients(const BoundaryParticles<Dim>& boundary,
                                         Particles<Dim>& fluid) const {
  close_.fit(search_.fluid_near_fluid(), vectors_of_group());
  for_fluid_groups(fluid.size(), [&](std::size_t group, NearBuffers& buffers) {
    GradientLanes<Dim> lanes;
    gather_gradients<Dim>(
        model_, node_lanes(fluid.node, fluid.size(), group),
        {unpack(search_.fluid_near_fluid().of(group), buffers.fluid), fluid.node.data()},
        {unpack(search_.boundary_near_fluid().of(group), buffers.boundary), boundary.node().data()},
        close_.of(group), lanes);
    for (std::size_t i = group * kGroup; i < group_end(group, fluid.size()); ++i) {
      const std::size_t l = i % kGroup;
      Fit<Dim>& fit = fluid.fit[i];
      fit.m0 = lanes.m0[l];
      fit.floored = lanes.floored[l];
      take<Dim>(lanes.g, l, fit.g);
      take<Dim>(lanes.G, l, fit.G);
      fluid.divergence[i] = lanes.divergence[l];
      take<Dim>(lanes.half_grad_rho, l, fluid.gradients[i].half_grad_rho);
      take<Dim>(lanes.half_strain, l, fluid.gradients[i].half_strain);
    }
  });
}

template <int Dim>
void GroupStages<Dim>::extrapolate(const Particles<Dim>& fluid, BoundaryParticles<Dim>& boundary) const {
  for_boundary_groups(search_.active_boundary(), [&](std::size_t group, const NearGroup& near) {
    StateLanes<Dim> lanes;
    put_body_velocities<Dim>(boundary, group, lanes.body_velocity);
    for (std::size_t l = 0; l < kGroup; ++l)
      put<Dim>(pull_across(model_, boundary, std::min(group * kGroup + l, boundary.size() - 1)), l,
               lanes.pull);
    gather_state<Dim>(model_, node_lanes(boundary.node(), boundary.size(), group), near, fluid, lanes);
    for (std::size_t w = group * kGroup; w < group_end(group, boundary.size()); ++w) {
      const std::size_t l = w % kGroup;
      const Moments<Dim> moments{lanes.m0[l], vec_at<Dim>(lanes.m1, l), sym_at<Dim>(lanes.m2, l)};
      Eigen::Matrix<double, 2, Dim> slopes;
      slopes.row(0) = vec_at<Dim>(lanes.px, l);
      slopes.row(1) = vec_at<Dim>(lanes.rhox, l);
      const Eigen::Vector2d sums(lanes.p[l], lanes.rho[l]);
      NearState<Dim> state{{moments, sums, slopes}, lanes.volume[l], lanes.dynamic[l]};
      state.g = vec_at<Dim>(lanes.g, l);
      state.fitted = lanes.fitted[l];
      take_over(model_, state, w, boundary);
    }
  });
}

template <int Dim>
void GroupStages<Dim>::compute_forces(const BoundaryParticles<Dim>& boundary,
                                      const MirrorGuard<Dim>& mirror_guard, Particles<Dim>& fluid) const {
  for_fluid_groups(fluid.size(), [&](std::size_t group, NearBuffers& buffers) {
    ForceLanes<Dim> lanes;
    for (std::size_t l = 0; l < kGroup; ++l) {
      const std::size_t i = std::min(group * kGroup + l, fluid.size() - 1);
      const FlowGradients<Dim>& flow = fluid.gradients[i];
      lanes.mass[l] = fluid.mass[i];
      put<Dim>(flow.half_grad_rho, l, lanes.half_grad_rho);
      for (std::size_t k = 0; k < Symmetric<Dim>::kEntries; ++k)
        lanes.half_strain[k][l] = flow.half_strain[k];
    }
    gather_forces<Dim>(model_, node_lanes(fluid.node, fluid.size(), group),
                       search_.fluid_near_fluid().of(group), close_.of(group), buffers.fluid, fluid,
                       unpack(search_.boundary_near_fluid().of(group), buffers.boundary), boundary, lanes);
    for (std::size_t i = group * kGroup; i < group_end(group, fluid.size()); ++i) {
      const std::size_t l = i % kGroup;
      for (int a = 0; a < Dim; ++a)
        fluid.acceleration[i][a] = model_.gravity[a] + lanes.acceleration[static_cast<std::size_t>(a)][l];
      mirror_guard.accelerate(i, fluid);
      fluid.density_rate[i] = lanes.density_rate[l];
    }
  });
}

template <int Dim>
void GroupStages<Dim>::react(const Particles<Dim>& fluid, const BoundaryParticles<Dim>& boundary,
                             const std::vector<std::uint32_t>& groups,
                             std::vector<Reaction<Dim>>& reaction) const {
  for_boundary_groups(groups, [&](std::size_t group, const NearGroup& near) {
    ReactionLanes<Dim> lanes;
    for (std::size_t l = 0; l < kGroup; ++l) {
      const std::size_t w = std::min(group * kGroup + l, boundary.size() - 1);
      lanes.pressure_volume[l] = boundary.pressure[w] * boundary.sampled_volume(w);
    }
    gather_reaction<Dim>(model_, node_lanes(boundary.node(), boundary.size(), group), near, fluid, lanes);
    for (std::size_t w = group * kGroup; w < group_end(group, boundary.size()); ++w) {
      reaction[w].force = vec_at<Dim>(lanes.force, w % kGroup);
      react_to_returned<Dim>(boundary, w, reaction[w]);
    }
  });
}

template class GroupStages<2>;
template class GroupStages<3>;

}  // namespace sluice::fluid
