#pragma once

#include <algorithm>
#include <span>

#include "fluid/boundary.hpp"
#include "fluid/extrapolation.hpp"
#include "fluid/model.hpp"

namespace sluice::fluid {

// At a no-slip surface the velocity along it goes through zero: depth over distance of the mirrored fluid,
// bounded by this, which reaches the deepest layer; with 2, Poiseuille flow is 1.6 % off at 25 across instead
// of 1.0 %.
inline constexpr double kLargestNoSlipRatio = 6.0;

// The velocity that boundary particle w has in the velocity gradients of the fluid: that of the fluid it
// stands in for, the mirror image of the flow. Relative to the body, the component across the surface changes
// sign; the component along it continues, linearly in the directions along the surface. At a no-slip surface
// that component changes sign as well, but in the shear only (no_slip.hpp), in proportion to the distances
// from it (J. Morris, P. Fox, Y. Zhu, J. Comput. Phys. 136, 1997, eq. 26). Across the surface that proportion
// assumes a flow that has come to rest at the wall: where liquid hits one it is up to twice too much, and
// brings energy in. With the body's own velocity instead, the divergence near a wall is about half of the
// fluid's and its stress power is lost: a standing wave in a tank one wave long loses 2 % a period at H/25.
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
  const Vec<Dim> along = flow.centroid() - surface.across * flow.centroid();
  const Vec<Dim> continued = flow.mean() - flow.slope(model.moment_floor) * along;
  node.v += continued - surface.across * (continued + flow.mean());
  if (!boundary.sticks() || !boundary.no_slip(w)) return;
  const double distance = std::max(flow.centroid().dot(surface.normal) - surface.depth, 0.25 * model.spacing);
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
