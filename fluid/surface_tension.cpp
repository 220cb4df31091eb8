#include "fluid/surface_tension.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace sluice::fluid {
namespace {

// Calls visit(a, x^2, y^2, z^2) for the points of the lattice within `reach` of one, a rows above it:
// the squares of what they are off, x across the rows.
template <int Dim, typename Visit>
void for_lattice(double reach, double dx, const Visit& visit) {
  const int most = static_cast<int>(reach / dx);
  const int deep = Dim == 3 ? most : 0;
  for (int a = -most; a <= most; ++a)
    for (int b = -most; b <= most; ++b)
      for (int c = -deep; c <= deep; ++c) visit(a, dx * dx * a * a, dx * dx * b * b, dx * dx * c * c);
}

template <int Dim>
double lattice_volume(double dx) {
  return Dim == 2 ? dx * dx : dx * dx * dx;
}

// Measured tension of drops, from pressure and period, over that of the undisturbed lattice: the particles at
// the surface settle closer to each other (README.md, "Surface tension").
template <int Dim>
constexpr double kSettled = Dim == 2 ? 1.42 : 1.75;

// The limit of capillary waves, J. Brackbill, D. Kothe, C. Zemach, J. Comput. Phys. 100, 1992, with
// h for the cell and the factor of J. Morris, Int. J. Numer. Meth. Fluids 33, 2000.
double capillary_step(double rho, double h, double sigma) {
  return 0.25 * std::sqrt(rho * h * h * h / (2.0 * std::numbers::pi * sigma));
}

}  // namespace

template <int Dim>
SurfaceTension<Dim>::SurfaceTension(const Setup& setup, double reach)
    : reach_(reach), largest_step_(std::numeric_limits<double>::infinity()) {
  const double sigma = setup.liquid.surface_tension, dx = setup.spacing;
  if (sigma == 0.0) return;
  at_zero_ = 1.0 / lattice_cover(static_cast<int>(reach / dx), dx);
  stiffness_ = 1.0;
  stiffness_ = sigma / (kSettled<Dim> * lattice_tension(dx));
  largest_step_ = capillary_step(setup.liquid.density, setup.formulation.smoothing * dx, sigma);
}

// On the undisturbed lattice, with `rows` rows between the particle and a plane surface.
template <int Dim>
double SurfaceTension<Dim>::lattice_cover(int rows, double dx) const {
  double sum = 0;
  for_lattice<Dim>(reach_, dx, [&](int a, double x2, double y2, double z2) {
    if (a <= rows) sum += lattice_volume<Dim>(dx) * weight(x2 + y2 + z2).value;
  });
  return sum;
}

// Stress along less stress across a plane surface of the lattice, integrated across it, which is what pulls
// at a curved one: J. Kirkwood, F. Buff, J. Chem. Phys. 17, 1949,
//   sigma = 1/(2 A) sum_i sum_k V_i V_k (e'_i + e'_k) F (x_n^2 - x_t^2)
// with x_n across and x_t along the surface. The pressure acts on both alike.
template <int Dim>
double SurfaceTension<Dim>::lattice_tension(double dx) const {
  const int deepest = 2 * static_cast<int>(reach_ / dx);
  const auto slope_at = [&](int row) { return stiffness_ * (lattice_cover(row, dx) - 1.0); };
  double sum = 0;
  for (int row = 0; row <= deepest; ++row)
    for_lattice<Dim>(reach_, dx, [&](int a, double x2, double y2, double z2) {
      if (a > row) return;
      sum += (slope_at(row) + slope_at(row - a)) * weight(x2 + y2 + z2).slope * (x2 - y2);
    });
  return 0.5 * sum * lattice_volume<Dim>(dx) * dx;
}

template <int Dim>
typename SurfaceTension<Dim>::Weight SurfaceTension<Dim>::weight(double r2) const {
  const double u = std::max(0.0, 1.0 - r2 / (reach_ * reach_));
  return {at_zero_ * u * u, at_zero_ * 4.0 / (reach_ * reach_) * u};
}

template <int Dim>
double SurfaceTension<Dim>::cover(const NeighborSearch<Dim>& search, const BoundaryParticles<Dim>& boundary,
                                  const Particles<Dim>& fluid, std::size_t i) const {
  const Vec<Dim>& x = fluid.node[i].x;
  double sum = fluid.node[i].volume * at_zero_;
  for (const std::uint32_t k : search.fluid_near_fluid(i))
    sum += fluid.node[k].volume * weight((x - fluid.node[k].x).squaredNorm()).value;
  for (const std::uint32_t w : search.boundary_near_fluid(i))
    sum += boundary.sampled_volume(w) * weight((x - boundary.node()[w].x).squaredNorm()).value;
  return sum;
}

template <int Dim>
void SurfaceTension<Dim>::compute(const NeighborSearch<Dim>& search, const BoundaryParticles<Dim>& boundary,
                                  const Parallel& parallel, Particles<Dim>& fluid) {
  missing_.resize(fluid.node.size());
  parallel.for_each(fluid.size(),
                    [&](std::size_t i) { missing_[i] = 1.0 - cover(search, boundary, fluid, i); });
  for (std::size_t k = fluid.size(); k < missing_.size(); ++k)
    missing_[k] = missing_[search.halo().particle(k, fluid)];
  energy_ = 0.0;
  for (std::size_t i = 0; i < fluid.size(); ++i)
    if (!fluid.is_buffer(i)) energy_ += fluid.node[i].volume * 0.5 * stiffness_ * missing_[i] * missing_[i];
  force_.resize(fluid.size());
  parallel.for_each(fluid.size(), [&](std::size_t i) { differentiate(search, boundary, fluid, i); });
}

template <int Dim>
void SurfaceTension<Dim>::differentiate(const NeighborSearch<Dim>& search,
                                        const BoundaryParticles<Dim>& boundary, Particles<Dim>& fluid,
                                        std::size_t i) {
  const Vec<Dim>& x = fluid.node[i].x;
  const double V = fluid.node[i].volume, missing = missing_[i];
  // Both over -B.
  double by_volume = V * missing * at_zero_ - 0.5 * missing * missing;
  Vec<Dim> pull = Vec<Dim>::Zero();
  for (const std::uint32_t k : search.fluid_near_fluid(i)) {
    const Vec<Dim> x_ik = x - fluid.node[k].x;
    const auto [K, F] = weight(x_ik.squaredNorm());
    by_volume += fluid.node[k].volume * missing_[k] * K;
    pull += fluid.node[k].volume * (missing + missing_[k]) * F * x_ik;
  }
  for (const std::uint32_t w : search.boundary_near_fluid(i)) {
    const Vec<Dim> x_iw = x - boundary.node()[w].x;
    pull += boundary.sampled_volume(w) * missing * weight(x_iw.squaredNorm()).slope * x_iw;
  }
  force_[i] = -stiffness_ * V * pull;
  const double stress = -stiffness_ * by_volume;  // dE/dV
  fluid.source[i].s += V * stress * fluid.fit[i].g;
  fluid.source[i].S += V * stress * fluid.fit[i].G;
}

template <int Dim>
void SurfaceTension<Dim>::accelerate(const Parallel& parallel, Particles<Dim>& fluid) const {
  parallel.for_each(fluid.size(), [&](std::size_t i) { fluid.acceleration[i] += force_[i] / fluid.mass[i]; });
}

template <int Dim>
void SurfaceTension<Dim>::react(const NeighborSearch<Dim>& search, const BoundaryParticles<Dim>& boundary,
                                const Parallel& parallel, const Particles<Dim>& fluid,
                                std::vector<Reaction<Dim>>& reaction) const {
  const auto& active = search.active_boundary();
  parallel.for_each(active.size(), [&](std::size_t a) {
    const std::size_t w = active[a];
    Vec<Dim> pull = Vec<Dim>::Zero();
    for (const std::uint32_t i : search.fluid_near_active(a)) {
      const Vec<Dim> x_iw = fluid.node[i].x - boundary.node()[w].x;
      pull += fluid.node[i].volume * missing_[i] * weight(x_iw.squaredNorm()).slope * x_iw;
    }
    reaction[w].force += stiffness_ * boundary.sampled_volume(w) * pull;
  });
}

template class SurfaceTension<2>;
template class SurfaceTension<3>;

}  // namespace sluice::fluid
