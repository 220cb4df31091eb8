#pragma once

#include "fluid/force_sweep.hpp"

namespace sluice::fluid {

// What of reaction() is not pressure: the springs of the penetration guard, and the viscous stress of the
// default operator (of the others it is not told apart from pressure). The rest is pressure.
template <int Dim>
struct ReactionParts {
  Reaction<Dim> viscous;
  Vec<Dim> guard = Vec<Dim>::Zero();  // [N]
};

// Of fluid particle i on boundary particle w.
template <int Dim, typename Kernel>
ReactionParts<Dim> reaction_parts(const Model<Dim, Kernel>& model, const Particles<Dim>& fluid, std::size_t i,
                                  std::size_t w, const BoundaryParticles<Dim>& boundary) {
  const Node<Dim>& node = boundary.node()[w];
  const Vec<Dim> x_iw = fluid.node[i].x - node.x;
  ReactionParts<Dim> parts;
  parts.guard = -guard_force<Dim>(model, x_iw);
  if constexpr (Operator<Dim, Kernel>::kIsDefault) {
    if (boundary.stress.empty()) return parts;
    const double W = model.kernel.value(x_iw);
    const double V_i = fluid.node[i].volume;
    const Vec<Dim> traction =
        -V_i * boundary.sampled_volume(w) * W * model.boundary_G * (boundary.stress[w] * x_iw);
    // V_i sigma_i (g + G x_wi) of set_source, with the viscous stress in the place of sigma.
    const Fit<Dim>& fit = fluid.fit[i];
    parts.viscous.force = -node.volume * W * V_i * (fluid.stress[i] * (fit.g - fit.G * x_iw)) - traction;
    parts.viscous.couple = -widen<Dim>(x_iw).cross(widen<Dim>(traction));
  }
  return parts;
}

}  // namespace sluice::fluid
