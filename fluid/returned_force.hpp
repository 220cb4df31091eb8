#pragma once

#include <algorithm>
#include <cmath>
#include <span>

#include "fluid/boundary.hpp"
#include "fluid/extrapolation.hpp"
#include "fluid/model.hpp"
#include "fluid/particles.hpp"

namespace sluice::fluid {

// Energy at the boundary. Fluid i exerts on boundary particle w the part F_iw of its stress that CF (43)
// hands to w, and the divergence of i contains w's mirrored velocity: the liquid's elastic energy loses
//   sum_i F_iw . u_w,   F_iw = V_w V_i p_i W (g_i + G_i x_wi),   u relative to the body.
// Its motion gains what w's traction t does, sum_i t_iw . u_i. A true image of a single particle gives back
// the one as the other. A boundary particle, which stands in for several particles at once with the lattice's
// g and G, does not: at rest neither moves anything, but where a splash hits a wall energy comes in, up to a
// third of all there was. But u_w is linear in the velocities it was taken from (boundary_velocity.hpp),
//   u_w = sum_i W_iw/m0 [T (1 - (x_iw - c) . q) - r A] u_i,   A across, T = 1 - A, q = C^-1 (c)_along,
// r the share that is reversed, c the centroid of the fluid near w and C its covariance, and the transpose of
// that map returns F_w to the fluid with exactly the work that it did:
//   t_iw = W_iw/m0 [T (1 - (x_iw - c) . q) - r A] F_w.
// It takes the place of the pressure in an impact, and there in the share in which that would bring energy
// in; everywhere, it would not do: a constant pressure is not at rest with it, the first rows of a tank shift
// by 3 % of p/(rho dx), roll, and pile up.

// Gain over the work from which on the pressure is replaced altogether.
inline constexpr double kFullGain = 0.05;

template <int Dim>
struct WorkSums {
  Moments<Dim> moments;               // of the fluid near
  Vec<Dim> force = Vec<Dim>::Zero();  // F_w [N]
  double returned = 0;                // sum_i t_iw . u_i of the pressure [W]
};

template <int Dim, typename Kernel>
WorkSums<Dim> sum_work(const Model<Dim, Kernel>& model, const Particles<Dim>& fluid,
                       std::span<const std::uint32_t> neighbors, std::size_t w,
                       const BoundaryParticles<Dim>& boundary) {
  WorkSums<Dim> sums;
  const Node<Dim>& node = boundary.node()[w];
  for (const std::uint32_t i : neighbors) {
    const Vec<Dim> x_iw = fluid.node[i].x - node.x;
    const double W = model.kernel.value(x_iw), WV = W * fluid.node[i].volume;
    sums.moments.add(W, x_iw);
    sums.force += WV * fluid.pressure[i] * (fluid.fit[i].g - fluid.fit[i].G * x_iw);
    sums.returned += WV * x_iw.dot(fluid.node[i].v - boundary.velocity(w));
  }
  sums.force *= node.volume;
  sums.returned *= boundary.sampled_volume(w) * boundary.pressure[w] * model.boundary_G;
  return sums;
}

// `share` of F_w, returned to the fluid near.
template <int Dim, typename Kernel>
ReturnedForce<Dim> return_force(const Model<Dim, Kernel>& model, const WorkSums<Dim>& sums, double share,
                                std::size_t w, const BoundaryParticles<Dim>& boundary) {
  const Mat<Dim>& across = boundary.surface(w).across;
  const Moments<Dim>& m = sums.moments;
  const Vec<Dim> c = m.m1 / m.m0, F = share * sums.force, F_across = across * F, F_along = F - F_across;
  const Vec<Dim> reversed = boundary.reversal[w] * F_across;
  const Vec<Dim> q = inverse_covariance<Dim>(m, model.moment_floor) * (c - across * c);
  ReturnedForce<Dim> back;
  back.s = ((1.0 + c.dot(q)) * F_along - reversed) / m.m0;
  back.S = -F_along * q.transpose() / m.m0;
  back.force = F_along - reversed;
  const Mat<Dim> moment = m.m1 * back.s.transpose() + m.m2 * back.S.transpose();  // sum W x (x) (s + S x)
  const auto turn = [&moment](int a, int b) { return moment(a, b) - moment(b, a); };
  back.couple.z() = turn(0, 1);
  if constexpr (Dim == 3) {
    back.couple.x() = turn(1, 2);
    back.couple.y() = turn(2, 0);
  }
  return back;
}

// Of a boundary particle in an impact. Takes the same share from its pressure.
template <int Dim, typename Kernel>
ReturnedForce<Dim> keep_work(const Model<Dim, Kernel>& model, const Particles<Dim>& fluid,
                             std::span<const std::uint32_t> neighbors, std::size_t w,
                             BoundaryParticles<Dim>& boundary) {
  const WorkSums<Dim> sums = sum_work(model, fluid, neighbors, w, boundary);
  const double work = sums.force.dot(boundary.node()[w].v - boundary.velocity(w));
  const double gain = sums.returned - work, full = kFullGain * std::abs(work);
  if (gain <= 0.0) return {};
  const double share = boundary.impact[w] * (gain < full ? gain / full : 1.0);
  boundary.pressure[w] *= 1.0 - share;
  return return_force(model, sums, share, w, boundary);
}

}  // namespace sluice::fluid
