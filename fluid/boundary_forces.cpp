#include "fluid/boundary_forces.hpp"

#include <algorithm>
#include <cmath>

#include "fluid/lattice.hpp"
#include "fluid/moments.hpp"
#include "fluid/sampling.hpp"

namespace sluice::fluid {
namespace {

// CF section 6.
constexpr double kRange = 0.7;  // r0/h
// A distance below this share of r0, about half of that between two boundary particles, counts as that. The
// paper's f2 has no bound: a particle that the edge of a body had carried onto one of its particles was
// thrown out at 10^14 times the speed of sound.
constexpr double kLeastDistance = 1.0 / 6.0;

// Sum over a plane surface's particles, dx/3 apart, of term(r^2) for a particle half a spacing above one.
template <int Dim, typename Term>
double plane_sum(double dx, double range, const Term& term) {
  const double edge = surface_spacing(dx);
  const int most = static_cast<int>(range / edge), deep = Dim == 3 ? most : 0;
  double sum = 0;
  for (int a = -most; a <= most; ++a)
    for (int b = -deep; b <= deep; ++b) sum += term(0.25 * dx * dx + edge * edge * (a * a + b * b));
  return sum;
}

// [Pa], as in boundary_forces.hpp.
double pressure_scale(const Setup& setup) {
  const double given = setup.formulation.boundary_pressure, speed = 0.1 * setup.liquid.sound_speed;
  return given > 0.0 ? given : 0.5 * setup.liquid.density * speed * speed;
}

}  // namespace

template <int Dim>
BoundaryForces<Dim>::BoundaryForces(const Setup& setup)
    : kernel_(setup.formulation.smoothing * setup.spacing),
      range_(kRange * setup.formulation.smoothing * setup.spacing),
      on_receding_(setup.formulation.force_on_receding) {
  if (setup.formulation.boundary != BoundaryTreatment::forces) return;
  floor_ = setup.formulation.moment_floor * lattice_moment<Dim>(kernel_, setup.spacing);
  strength_ = 1.0;
  const double per_A = plane_sum<Dim>(setup.spacing, range_, [this](double r2) { return magnitude(r2); });
  strength_ = pressure_scale(setup) * std::pow(setup.spacing, Dim - 1) / per_A;
}

// The point of the surface in front of the particle, which is sampled half its edge behind it.
template <int Dim>
Vec<Dim> BoundaryForces<Dim>::place(const BoundaryParticles<Dim>& boundary, std::size_t k) {
  const Surface<Dim>& surface = boundary.surface(k);
  return boundary.node()[k].x + surface.depth * surface.normal;
}

// |f2| of CF (113), 0 beyond r0.
template <int Dim>
double BoundaryForces<Dim>::magnitude(double r2) const {
  const double r = std::max(std::sqrt(r2), kLeastDistance * range_);
  const double q = range_ / r, q2 = q * q;
  return std::max(0.0, strength_ / r * (q2 * q2 - q2));
}

// CF (111)-(112).
template <int Dim>
Vec<Dim> BoundaryForces<Dim>::force(const Vec<Dim>& x_j, const Pushed& j,
                                    const BoundaryParticles<Dim>& boundary, std::size_t k) const {
  const Vec<Dim>& normal = boundary.surface(k).normal;
  const bool approaches = (j.velocity - boundary.velocity(k)).dot(normal) < 0.0;
  if (!approaches && !on_receding_) return Vec<Dim>::Zero();
  return magnitude((x_j - place(boundary, k)).squaredNorm()) * normal;
}

template <int Dim>
bool BoundaryForces<Dim>::is_near(const Vec<Dim>& x, std::span<const std::uint32_t> near,
                                  const BoundaryParticles<Dim>& boundary) const {
  return std::any_of(near.begin(), near.end(), [&](std::uint32_t k) {
    return (x - place(boundary, k)).squaredNorm() < range_ * range_;
  });
}

template <int Dim>
typename BoundaryForces<Dim>::Pushed BoundaryForces<Dim>::pushed(const NeighborSearch<Dim>& search,
                                                                 const BoundaryParticles<Dim>& boundary,
                                                                 const Particles<Dim>& fluid,
                                                                 std::size_t j) const {
  const Vec<Dim>& x_j = fluid.node[j].x;
  const auto near = search.boundary_near_fluid(j);
  Pushed result;
  result.is_near = is_near(x_j, near, boundary);
  if (!result.is_near) return result;
  Moments<Dim> moments;
  Vec<Dim> P = Vec<Dim>::Zero();
  Mat<Dim> Q = Mat<Dim>::Zero();
  moments.add(fluid.node[j].volume * kernel_.at_zero(), Vec<Dim>::Zero());
  for (const std::uint32_t i : search.fluid_near_fluid(j)) {
    const Vec<Dim> x_ij = fluid.node[i].x - x_j;
    const double VW = fluid.node[i].volume * kernel_.value(x_ij);
    moments.add(VW, x_ij);
    P += VW * (predicted_[i] - predicted_[j]);
    Q += VW * (predicted_[i] - predicted_[j]) * x_ij.transpose();
  }
  const Fit<Dim> f = fit(moments, floor_);
  result.a = shape_constant(f);
  result.g = f.g;
  result.velocity = predicted_[j] + result.a * P + Q * f.g;
  result.offset = result.a * moments.m1 + moments.m2 * f.g;
  for (const std::uint32_t k : near) result.force += force(x_j, result, boundary, k);
  return result;
}

// sum_j F_j N_i(x_j), i itself included.
template <int Dim>
Vec<Dim> BoundaryForces<Dim>::handed_on(const NeighborSearch<Dim>& search, const Particles<Dim>& fluid,
                                        std::size_t i) const {
  Vec<Dim> sum = pushed_[i].a * kernel_.at_zero() * pushed_[i].force;
  for (const std::uint32_t j : search.fluid_near_fluid(i)) {
    if (!pushed_[j].is_near) continue;
    const Vec<Dim> x_ij = fluid.node[i].x - fluid.node[j].x;
    sum += kernel_.value(x_ij) * (pushed_[j].a + pushed_[j].g.dot(x_ij)) * pushed_[j].force;
  }
  return fluid.node[i].volume * sum;
}

template <int Dim>
void BoundaryForces<Dim>::accelerate(const NeighborSearch<Dim>& search,
                                     const BoundaryParticles<Dim>& boundary, const Parallel& parallel,
                                     Particles<Dim>& fluid) {
  const std::size_t n = fluid.size();
  predicted_.resize(fluid.node.size());
  pushed_.resize(fluid.node.size());
  parallel.for_each(n, [&](std::size_t i) { predicted_[i] = fluid.node[i].v + dt_ * fluid.acceleration[i]; });
  for (std::size_t k = n; k < predicted_.size(); ++k)
    predicted_[k] = predicted_[search.halo().particle(k, fluid)];
  parallel.for_each(n, [&](std::size_t j) { pushed_[j] = pushed(search, boundary, fluid, j); });
  for (std::size_t k = n; k < pushed_.size(); ++k) pushed_[k] = pushed_[search.halo().particle(k, fluid)];
  parallel.for_each(
      n, [&](std::size_t i) { fluid.acceleration[i] += handed_on(search, fluid, i) / fluid.mass[i]; });
}

template <int Dim>
void BoundaryForces<Dim>::react(const NeighborSearch<Dim>& search, const BoundaryParticles<Dim>& boundary,
                                const Parallel& parallel, const Particles<Dim>& fluid,
                                std::vector<Reaction<Dim>>& reaction) const {
  const auto& active = search.active_boundary();
  parallel.for_each(active.size(), [&](std::size_t a) {
    const std::size_t k = active[a];
    for (const std::uint32_t j : search.fluid_near_active(a)) {
      if (!pushed_[j].is_near) continue;
      const Vec<Dim>& x_j = fluid.node[j].x;
      const Vec<Dim> F = force(x_j, pushed_[j], boundary, k);
      const Vec<Dim> arm = x_j + pushed_[j].offset - boundary.node()[k].x;
      reaction[k].force -= F;
      reaction[k].couple -= widen<Dim>(arm).cross(widen<Dim>(F));
    }
  });
}

template class BoundaryForces<2>;
template class BoundaryForces<3>;

}  // namespace sluice::fluid
