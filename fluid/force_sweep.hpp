#pragma once

#include <span>

#include "fluid/boundary.hpp"
#include "fluid/isobaric.hpp"
#include "fluid/model.hpp"
#include "fluid/particles.hpp"

namespace sluice::fluid {

// Force of boundary particle w, as a quadrature point with g = 0 and the lattice's G, on fluid particle i:
//   -V_i V_w W sigma_w G x_iw   (README.md, "Boundary particles")
// with F in the place of W for other operators than the default, which have it there.
template <int Dim, typename Kernel>
Vec<Dim> boundary_traction(const Model<Dim, Kernel>& model, const BoundaryParticles<Dim>& boundary,
                           std::size_t w, const Particles<Dim>& fluid, std::size_t i,
                           const ValueAndSlope& weight, const Vec<Dim>& x_iw) {
  using Rule = Operator<Dim, Kernel>;
  const double scale =
      fluid.node[i].volume * boundary.sampled_volume(w) * Rule::lattice_weight(weight) * model.boundary_G;
  double pressure = boundary.pressure[w];
  if constexpr (Rule::kIsIsobaric)
    pressure = isobaric_pressure({fluid.pressure[i], fluid.node[i].rho},
                                 {boundary.pressure[w], boundary.node()[w].rho}, model.isobaric_scale);
  Vec<Dim> force = scale * pressure * x_iw;
  if (!boundary.stress.empty()) force -= scale * (boundary.stress[w] * x_iw);
  return force;
}

// What it gives back to the fluid in an impact, returned_force.hpp.
template <int Dim>
Vec<Dim> returned_traction(const BoundaryParticles<Dim>& boundary, std::size_t w, double W,
                           const Vec<Dim>& x_iw) {
  const ReturnedForce<Dim>* back = boundary.returned(w);
  return back == nullptr ? Vec<Dim>(Vec<Dim>::Zero()) : Vec<Dim>(W * (back->s + back->S * x_iw));
}

// Penetration guard: a spring between a fluid and a boundary particle nearer than kGuardRange spacings, which
// on a lattice they never are. Takes the place of the boundary forces CF (113), with the scale m c0^2/dx^2
// that the paper leaves open and without its velocity switch, so that it conserves energy: a single particle
// that drifts into the wall between its neighbours changes no divergence, and so no pressure would stop it.
// Force on the particle at the head of x_iw.
template <int Dim, typename Kernel>
Vec<Dim> guard_force(const Model<Dim, Kernel>& model, const Vec<Dim>& x_iw) {
  const double r2 = x_iw.squaredNorm();
  if (r2 >= model.guard_range * model.guard_range) return Vec<Dim>::Zero();
  const double r = std::sqrt(r2 + model.tiny_r2);
  return model.guard_stiffness * (model.guard_range / r - 1.0) * x_iw;
}

// Energy [J] stored in that spring.
template <int Dim, typename Kernel>
double guard_energy(const Model<Dim, Kernel>& model, const Vec<Dim>& x_iw) {
  const double r2 = x_iw.squaredNorm();
  if (r2 >= model.guard_range * model.guard_range) return 0.0;
  const double stretch = model.guard_range - std::sqrt(r2 + model.tiny_r2);
  return 0.5 * model.guard_stiffness * stretch * stretch;
}

// Sweep 2: what the neighbours k of particle i do to it. The internal force is CF (43) with nodal quadrature,
//   f_i = -sum_k V_k sigma_k grad N_i(x_k) = -V_i sum_k W_ik (s_k + S_k x_ik),
// with s and S from sweep 1; k runs over the fluid, i itself (x_ii = 0) and the boundary.
template <int Dim, typename Kernel = WendlandC2<Dim>>
class ForceSweep {
 public:
  ForceSweep(const Model<Dim, Kernel>& model, const Particles<Dim>& fluid, std::size_t i)
      : model_(model), fluid_(fluid), i_(i), node_(fluid.node[i]), flow_(fluid.gradients[i]) {
    if constexpr (Rule::kHasPoints)
      internal_ = Rule::point_flux(model, fluid, i, Vec<Dim>::Zero());
    else
      internal_ = Rule::own_flux(fluid.source[i], model.kernel.at_zero());
  }

  void gather_fluid(std::span<const std::uint32_t> neighbors) {
    for (const std::uint32_t k : neighbors) add_fluid(k);
  }

  void gather_boundary(std::span<const std::uint32_t> neighbors, const BoundaryParticles<Dim>& boundary) {
    for (const std::uint32_t w : neighbors) {
      const Vec<Dim> x_iw = node_.x - boundary.node()[w].x;
      const ValueAndSlope weight = Rule::weight(model_.kernel, x_iw);
      traction_ += boundary_traction(model_, boundary, w, fluid_, i_, weight, x_iw) +
                   returned_traction(boundary, w, weight.w, x_iw) + guard_force(model_, x_iw);
    }
  }

  [[nodiscard]] Vec<Dim> force() const {
    return traction_ - node_.volume * internal_ + model_.artificial_viscosity * node_.volume * viscous_;
  }
  [[nodiscard]] double density_rate() const { return model_.density_diffusion * diffusion_; }

 private:
  using Rule = Operator<Dim, Kernel>;

  void add_fluid(std::size_t index) {
    const Node<Dim>& k = fluid_.node[index];
    const FlowGradients<Dim>& flow = fluid_.gradients[index];
    const Vec<Dim> x_ik = node_.x - k.x;
    const double r2 = x_ik.squaredNorm();
    const ValueAndSlope weight = model_.kernel.value_and_slope(x_ik);
    const double F = weight.f;
    if constexpr (Rule::kHasPoints)
      internal_ += Rule::point_flux(model_, fluid_, index, x_ik);
    else
      internal_ += Rule::flux(fluid_, index, weight, x_ik);
    if constexpr (Rule::kIsIsobaric)
      internal_ -= k.volume * F *
                   isobaric_pressure({fluid_.pressure[i_], node_.rho}, {fluid_.pressure[index], k.rho},
                                     model_.isobaric_scale) *
                   x_ik;

    // Artificial viscosity on what a linear velocity field does not explain (README.md, "Dissipation"):
    //   alpha h c0 rho0 V_i V_k [v_ki . x_ki - x_ki . (d_i + d_k)/2 x_ki] / r^2 F x_ki
    const double VF = k.volume * F;
    const double unexplained =
        (node_.v - k.v).dot(x_ik) - x_ik.dot((flow_.half_strain + flow.half_strain) * x_ik);
    viscous_ -= VF * unexplained / (r2 + model_.tiny_r2) * x_ik;

    // Density diffusion on what a linear density field does not explain (M. Antuono et al., Comput. Phys.
    // Commun. 181, 2010, eq. 6): 2 delta h c0 sum_k V_k F [rho_ki - (grad rho_i + grad rho_k)/2 . x_ki]
    diffusion_ += VF * (k.rho - node_.rho + (flow_.half_grad_rho + flow.half_grad_rho).dot(x_ik));
  }

  const Model<Dim, Kernel>& model_;
  const Particles<Dim>& fluid_;
  std::size_t i_;
  const Node<Dim>& node_;
  const FlowGradients<Dim>& flow_;
  Vec<Dim> internal_ = Vec<Dim>::Zero();
  Vec<Dim> traction_ = Vec<Dim>::Zero();
  Vec<Dim> viscous_ = Vec<Dim>::Zero();
  double diffusion_ = 0;
};

// What the fluid does to a boundary particle: force, and the moment about the particle itself (widened to
// three dimensions), since a viscous traction acts at the fluid particle and along another direction than the
// connection.
template <int Dim>
struct Reaction {
  Vec<Dim> force = Vec<Dim>::Zero();                 // [N]
  Eigen::Vector3d couple = Eigen::Vector3d::Zero();  // [N m]
};

template <int Dim>
void react_to_returned(const BoundaryParticles<Dim>& boundary, std::size_t w, Reaction<Dim>& sum) {
  const ReturnedForce<Dim>* back = boundary.returned(w);
  if (back == nullptr) return;
  sum.force -= back->force;
  sum.couple -= back->couple;
}

// The exact reaction: what the fluid particles near boundary particle w do to it. Fluid particle i
// distributes its stress to w like to any neighbour, and takes w's traction with the opposite sign.
template <int Dim, typename Kernel>
Reaction<Dim> reaction(const Model<Dim, Kernel>& model, const Particles<Dim>& fluid,
                       std::span<const std::uint32_t> neighbors, std::size_t w,
                       const BoundaryParticles<Dim>& boundary) {
  using Rule = Operator<Dim, Kernel>;
  const Node<Dim>& node = boundary.node()[w];
  Reaction<Dim> sum;
  for (const std::uint32_t i : neighbors) {
    const Vec<Dim> x_iw = fluid.node[i].x - node.x;
    const ValueAndSlope weight = Rule::weight(model.kernel, x_iw);
    const Vec<Dim> traction = boundary_traction<Dim>(model, boundary, w, fluid, i, weight, x_iw);
    if constexpr (Rule::kHasPoints)
      sum.force -= node.volume * Rule::point_flux(model, fluid, i, -x_iw);
    else
      sum.force -= Rule::flux(fluid, i, {node.volume * weight.w, node.volume * weight.f}, -x_iw);
    sum.force -= traction + guard_force<Dim>(model, x_iw);
    if (!boundary.stress.empty()) sum.couple -= widen<Dim>(x_iw).cross(widen<Dim>(traction));
  }
  react_to_returned<Dim>(boundary, w, sum);
  return sum;
}

}  // namespace sluice::fluid
