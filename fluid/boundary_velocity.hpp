#pragma once

#include <algorithm>
#include <span>

#include "fluid/boundary.hpp"
#include "fluid/extrapolation.hpp"
#include "fluid/model.hpp"

namespace sluice::fluid {

// Depth over distance of the mirrored fluid is bounded: particles deep in the wall would otherwise multiply
// the noise of a single particle at the surface. At no-slip surfaces, where the flow is viscous, the bound
// reaches the deepest layer; with 2, Poiseuille flow is 1.6 % off at 25 across instead of 1.0 %.
inline constexpr double kLargestRatio = 2.0, kLargestNoSlipRatio = 6.0;

// How one-sided the fluid near is where no part of it has come to rest at the surface: a single row.
inline constexpr double kSingleRow = 0.04;

// Speed over c0 up to which the image follows fluid that comes off a surface without pressure. With 0.02 the
// bound is at work at the edge of a gate that a jet comes off, too, and the discharge 5.8 instead of 4.6 %
// below theory.
inline constexpr double kParting = 0.05;

// Share of the flow's mean across the surface that the image has reversed. In a flow that has come to rest at
// the surface it is the depth over the distance of the mirrored fluid (J. Morris, P. Fox, Y. Zhu, J. Comput.
// Phys. 136, 1997, eq. 26). Where liquid hits a surface it has not: there that would be up to twice too much,
// and the image of a single row is the row, as fast; what is between has a share of both, by how one-sided
// the fluid near was when it last gave its pressure.
//   Off a surface, the image follows as far as liquid can: beyond the speed p/(rho c0) that sound gives to a
// surface which is set free (the Riemann problem of sound with nothing on one side) a void opens, and no
// image beyond it pulls. Else a gate that starts with a jump of velocity puts tension into the row beside it
// that no work was done for.
template <int Dim, typename Kernel>
double reversal(const Model<Dim, Kernel>& model, const Extrapolation<Dim, Dim>& flow, double distance,
                std::size_t w, const BoundaryParticles<Dim>& boundary) {
  const Surface<Dim>& surface = boundary.surface(w);
  const double single = std::min(1.0, boundary.one_sided[w] / kSingleRow);
  const double share = single + (1.0 - single) * std::min(surface.depth / distance, kLargestRatio);
  const double c0 = model.eos.sound_speed();
  const double parting = flow.mean().dot(surface.normal);
  const double most = boundary.pressure[w] / (boundary.node()[w].rho * c0) + kParting * c0;
  return parting > most ? (1.0 + share) * most / parting - 1.0 : share;
}

// The velocity that boundary particle w has in the velocity gradients of the fluid: that of the fluid it
// stands in for, the mirror image of the flow. Relative to the body, the component across the surface changes
// sign; the component along it continues, linearly in the directions along the surface. At a no-slip surface
// that component changes sign as well, but in the shear only (no_slip.hpp), in proportion to the distances
// from it. With the body's own velocity instead, the divergence near a wall is about half of the fluid's and
// its stress power is lost: a standing wave in a tank one wave long loses 2 % a period at H/25.
// `flow` is that of the fluid near relative to the body.
template <int Dim, typename Kernel>
void mirror_flow(const Model<Dim, Kernel>& model, const Extrapolation<Dim, Dim>& flow, std::size_t w,
                 BoundaryParticles<Dim>& boundary) {
  Node<Dim>& node = boundary.node()[w];
  const Vec<Dim>& body = boundary.velocity(w);
  node.v = body;
  if (boundary.sticks()) boundary.sticking[w].setZero();
  if (flow.empty()) return;
  const Surface<Dim>& surface = boundary.surface(w);
  const double distance = std::max(flow.centroid().dot(surface.normal) - surface.depth, 0.25 * model.spacing);
  boundary.reversal[w] = reversal(model, flow, distance, w, boundary);
  const Vec<Dim> along = flow.centroid() - surface.across * flow.centroid();
  const Vec<Dim> continued = flow.mean() - flow.slope(model.moment_floor) * along;
  node.v += continued - surface.across * (continued + boundary.reversal[w] * flow.mean());
  if (!boundary.sticks() || !boundary.no_slip(w)) return;
  const Vec<Dim> stuck = body - std::min(surface.depth / distance, kLargestNoSlipRatio) * flow.mean();
  boundary.sticking[w] = stuck - node.v;
}

// The same from the fluid particles near.
template <int Dim, typename Kernel>
void mirror_velocity(const Model<Dim, Kernel>& model, const Particles<Dim>& fluid,
                     std::span<const std::uint32_t> neighbors, std::size_t w,
                     BoundaryParticles<Dim>& boundary) {
  Extrapolation<Dim, Dim> flow;
  for (const std::uint32_t f : neighbors) {
    const Vec<Dim> x_fw = fluid.node[f].x - boundary.node()[w].x;
    flow.add(model.kernel.value(x_fw), x_fw, fluid.node[f].v - boundary.velocity(w));
  }
  mirror_flow(model, flow, w, boundary);
}

}  // namespace sluice::fluid
