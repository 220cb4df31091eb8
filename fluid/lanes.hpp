#pragma once

// The vectorised sweeps over a group of particles, a lane each; every instruction set that the build knows
// has its own version, and the processor's best is taken at run time. They are the sums of
// gradient_sweep.hpp, force_sweep.hpp and boundary_sweep.hpp with Wendland's kernel, which say what they
// mean; a group's own particles are among its neighbours, where they add what belongs to x = 0.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "fluid/boundary.hpp"
#include "fluid/close_list.hpp"
#include "fluid/group_list.hpp"
#include "fluid/model.hpp"
#include "fluid/particles.hpp"

namespace sluice::fluid {

// One double of each particle of a group.
struct alignas(64) Lanes {
  std::array<double, kGroup> of;
  double& operator[](std::size_t lane) { return of[lane]; }
  double operator[](std::size_t lane) const { return of[lane]; }
};

template <int Dim>
using LaneVec = std::array<Lanes, Dim>;
template <int Dim>
using LaneMat = std::array<Lanes, Dim * Dim>;  // by rows
template <int Dim>
using LaneSym = std::array<Lanes, Symmetric<Dim>::kEntries>;

// The particles of a group; behind the last one it is repeated.
template <int Dim>
struct NodeLanes {
  LaneVec<Dim> x, v;
  Lanes volume, rho;
};

template <int Dim>
NodeLanes<Dim> node_lanes(const std::vector<Node<Dim>>& node, std::size_t count, std::size_t group) {
  NodeLanes<Dim> lanes;
  for (std::size_t l = 0; l < kGroup; ++l) {
    const Node<Dim>& n = node[std::min(group * kGroup + l, count - 1)];
    for (std::size_t a = 0; a < Dim; ++a) {
      lanes.x[a][l] = n.x[a];
      lanes.v[a][l] = n.v[a];
    }
    lanes.volume[l] = n.volume;
    lanes.rho[l] = n.rho;
  }
  return lanes;
}

// What the sweeps take from the model.
template <int Dim>
using LaneModel = Model<Dim, WendlandC2<Dim>>;

// Adds to `members` those of first .. last-1, or of `some` in their order, that are within `reach` of a
// particle of the group.
template <int Dim>
void add_near(const LaneVec<Dim>& x, double reach, const Node<Dim>* node, std::uint32_t first,
              std::uint32_t last, std::vector<Members>& members);
template <int Dim>
void add_near(const LaneVec<Dim>& x, double reach, const Node<Dim>* node, std::span<const std::uint32_t> some,
              std::vector<Members>& members);

// Numbers of items are written a vector at a time, up to so many beyond their end.
inline constexpr std::size_t kRoomBeyond = kGroup;

// Of every set of members their places in the group; zeros behind them.
inline constexpr auto kPlaces = [] {
  std::array<std::array<std::uint8_t, kGroup>, 1 << kGroup> places{};
  for (std::size_t bits = 0; bits < places.size(); ++bits) {
    std::size_t count = 0;
    for (std::uint8_t place = 0; place < kGroup; ++place)
      if (bits >> place & 1) places[bits][count++] = place;
  }
  return places;
}();

// The numbers of what is near a group, in `buffer`, with that room.
NearGroup unpack(const NearItems& near, std::vector<std::uint32_t>& buffer);

// What is near a group, and whose index that is.
template <int Dim>
struct NearNodes {
  NearGroup near;
  const Node<Dim>* node;
};

// Vectors that a group is done in.
std::size_t vectors_of_group();

// Sweep 1: the fit and the gradients, gradient_sweep.hpp; and which fluid is `close`, where no lanes are
// masked.
template <int Dim>
struct GradientLanes {
  Lanes m0, divergence;
  LaneVec<Dim> g, half_grad_rho;
  LaneSym<Dim> G, half_strain;
  std::array<bool, kGroup> floored;
};
template <int Dim>
void gather_gradients(const LaneModel<Dim>& model, const NodeLanes<Dim>& group, const NearNodes<Dim>& fluid,
                      const NearNodes<Dim>& boundary, const CloseGroup& close, GradientLanes<Dim>& out);

// Sweep 2, of what is `close` unless lanes are masked: acceleration and density rate, force_sweep.hpp.
// `buffer` is for the numbers of the fluid.
template <int Dim>
struct ForceLanes {
  // Of the group:
  Lanes mass;
  LaneSym<Dim> half_strain;
  LaneVec<Dim> half_grad_rho;
  // Results:
  LaneVec<Dim> acceleration;  // without gravity
  Lanes density_rate;
};
template <int Dim>
void gather_forces(const LaneModel<Dim>& model, const NodeLanes<Dim>& group, const NearItems& fluid,
                   const CloseGroup& close, std::vector<std::uint32_t>& buffer,
                   const Particles<Dim>& particles, const NearGroup& boundary,
                   const BoundaryParticles<Dim>& walls, ForceLanes<Dim>& lanes);

// What a group of boundary particles takes from the fluid near it. Sums over f of W times
//   1, x_fw, x_fw (x) x_fw,   and of the fluid's velocity relative to the body, plain and times x_fw:
// boundary_velocity.hpp.
template <int Dim>
struct FlowLanes {
  LaneVec<Dim> body_velocity;
  Lanes m0;
  LaneVec<Dim> m1, v;
  LaneSym<Dim> m2;
  LaneMat<Dim> vx;
};
template <int Dim>
void gather_flow(const LaneModel<Dim>& model, const NodeLanes<Dim>& group, const NearNodes<Dim>& fluid,
                 FlowLanes<Dim>& lanes);

// The same of the pressure and the density, continued across the surface, with the sums of the volume and of
// the dynamic pressure: boundary_sweep.hpp.
template <int Dim>
struct StateLanes {
  LaneVec<Dim> body_velocity;
  LaneVec<Dim> pull;  // (g - a) . n n [m/s^2]
  Lanes m0, p, rho, volume, dynamic, fitted;
  LaneVec<Dim> m1, px, rhox, g;
  LaneSym<Dim> m2;
};
template <int Dim>
void gather_state(const LaneModel<Dim>& model, const NodeLanes<Dim>& group, const NearGroup& fluid,
                  const Particles<Dim>& particles, StateLanes<Dim>& lanes);

// The fluid's force on the boundary particles of a group [N], and for a viscous fluid its moment about each
// of them [N m] (in two dimensions the last of the three): `reaction` of force_sweep.hpp.
template <int Dim>
struct ReactionLanes {
  Lanes pressure_volume;  // of the boundary particles [N m^(Dim-2)]
  LaneVec<Dim> force;
};
template <int Dim>
void gather_reaction(const LaneModel<Dim>& model, const NodeLanes<Dim>& group, const NearGroup& fluid,
                     const Particles<Dim>& particles, ReactionLanes<Dim>& lanes);

}  // namespace sluice::fluid
