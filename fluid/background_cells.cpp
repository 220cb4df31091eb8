#include "fluid/background_cells.hpp"

#include <cmath>
#include <numeric>

#include "fluid/lattice.hpp"
#include "fluid/moments.hpp"

namespace sluice::fluid {
namespace {

// Lists reach farther than the support: most of what they hold is left at once.
template <int Dim>
bool is_seen(const WendlandC2<Dim>& kernel, const Vec<Dim>& x) {
  return x.squaredNorm() < kernel.support() * kernel.support();
}

}  // namespace

template <int Dim>
BackgroundCells<Dim>::BackgroundCells(const Setup& setup)
    : is_used_(setup.formulation.quadrature == Quadrature::background_cells),
      kernel_(setup.formulation.smoothing * setup.spacing),
      eos_(setup.liquid.density, setup.liquid.sound_speed),
      floor_(setup.formulation.moment_floor * lattice_moment<Dim>(kernel_, setup.spacing)),
      origin_(narrow<Dim>(setup.period.lower)),
      edge_(Vec<Dim>::Constant(0.5 * setup.spacing)),
      count_(Index::Zero()) {
  for (int a = 0; a < Dim; ++a) {
    const double length = setup.period.length[a];
    if (length <= 0.0) continue;
    count_[a] = std::llround(length / edge_[a]);
    edge_[a] = length / static_cast<double>(count_[a]);
  }
}

// A particle gives volume to points up to dx away along every axis.
template <int Dim>
double BackgroundCells<Dim>::extra_reach(const Formulation& formulation, double spacing) {
  return formulation.quadrature == Quadrature::background_cells
             ? std::sqrt(static_cast<double>(Dim)) * spacing
             : 0.0;
}

// Points that are one and the same across a periodic side have one key.
template <int Dim>
std::uint64_t BackgroundCells<Dim>::key(const Index& point) const {
  constexpr int kBits = 64 / Dim;
  constexpr std::int64_t kMiddle = std::int64_t{1} << (kBits - 1);
  std::uint64_t key = 0;
  for (int a = 0; a < Dim; ++a) {
    std::int64_t at = point[a];
    if (count_[a] > 0)
      at -= count_[a] *
            static_cast<std::int64_t>(std::floor(static_cast<double>(at) / static_cast<double>(count_[a])));
    key = key << kBits | (static_cast<std::uint64_t>(at + kMiddle) & ((std::uint64_t{1} << kBits) - 1));
  }
  return key;
}

template <int Dim>
void BackgroundCells<Dim>::give(const Index& point, const Vec<Dim>& x, double volume,
                                std::uint32_t particle) {
  const auto [at, is_new] = number_.try_emplace(key(point), static_cast<std::uint32_t>(point_.size()));
  if (is_new) {
    point_.emplace_back();
    point_.back().x = x;
    point_.back().owner = particle;
  }
  point_[at->second].weight += volume;
}

// Points stand at half places of the grid of edge dx/2. Along an axis 1 - |x|/dx at the four points within dx
// of a particle has the sum two.
template <int Dim>
void BackgroundCells<Dim>::spread_volumes(const Particles<Dim>& fluid) {
  constexpr int kAlong = 4;
  number_.clear();
  point_.clear();
  for (std::uint32_t i = 0; i < fluid.size(); ++i) {
    const Vec<Dim> place = (fluid.node[i].x - origin_).cwiseQuotient(edge_) - Vec<Dim>::Constant(0.5);
    const Index first = (place.array().floor().template cast<std::int64_t>() - 1).matrix();
    for (int n = 0; n < (Dim == 2 ? kAlong * kAlong : kAlong * kAlong * kAlong); ++n) {
      Index point = first;
      for (int a = 0, rest = n; a < Dim; ++a, rest /= kAlong) point[a] += rest % kAlong;
      const Vec<Dim> at = point.template cast<double>();
      double share = 1.0;
      for (int a = 0; a < Dim; ++a) share *= 0.5 * (1.0 - 0.5 * std::abs(at[a] - place[a]));
      const Vec<Dim> x = origin_ + edge_.cwiseProduct(at + Vec<Dim>::Constant(0.5));
      if (share > 0.0) give(point, x, share * fluid.node[i].volume, i);
    }
  }
}

template <int Dim>
void BackgroundCells<Dim>::sort_by_owner(std::size_t particles) {
  first_.assign(particles + 1, 0);
  for (const Point& q : point_) ++first_[q.owner + 1];
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  std::vector<Point> sorted(point_.size());
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  for (const Point& q : point_) sorted[next[q.owner]++] = q;
  point_.swap(sorted);
}

// CF (49), and the viscous stress alike.
template <int Dim>
void BackgroundCells<Dim>::find_stress(const NeighborSearch<Dim>& search,
                                       const BoundaryParticles<Dim>& boundary, const Particles<Dim>& fluid,
                                       Point& q) const {
  Moments<Dim> moments;
  double rho = 0;
  Vec<Dim> rho_x = Vec<Dim>::Zero();
  const auto add = [&](const Node<Dim>& j, double rho_j) {
    const Vec<Dim> x_jq = j.x - q.x;
    if (!is_seen(kernel_, x_jq)) return;
    const double VW = j.volume * kernel_.value(x_jq);
    moments.add(VW, x_jq);
    rho += VW * rho_j;
    rho_x += VW * rho_j * x_jq;
  };
  add(fluid.node[q.owner], fluid.node[q.owner].rho);
  for (const std::uint32_t j : search.fluid_near_fluid(q.owner))
    add(fluid.node[j], fluid.node[search.halo().particle(j, fluid)].rho);
  for (const std::uint32_t w : search.boundary_near_fluid(q.owner))
    add(boundary.node()[w], boundary.node()[w].rho);
  const Fit<Dim> f = fit(moments, floor_);
  const double at_q = f.floored ? rho / moments.m0 : shape_constant(f) * rho + f.g.dot(rho_x);
  Mat<Dim> sigma = -eos_.pressure(at_q) * Mat<Dim>::Identity();
  if (!fluid.stress.empty() && !f.floored) sigma += shear(search, boundary, fluid, f, q);
  q.s = q.weight * (sigma * f.g);
  q.S = q.weight * (sigma * f.G);
}

// The viscous stress at a point [Pa].
template <int Dim>
Mat<Dim> BackgroundCells<Dim>::shear(const NeighborSearch<Dim>& search,
                                     const BoundaryParticles<Dim>& boundary, const Particles<Dim>& fluid,
                                     const Fit<Dim>& f, const Point& q) const {
  Mat<Dim> sum = Mat<Dim>::Zero();
  const double a = shape_constant(f);
  const auto add = [&](const Node<Dim>& j, const Mat<Dim>& stress) {
    const Vec<Dim> x_jq = j.x - q.x;
    sum += j.volume * kernel_.value(x_jq) * (a + f.g.dot(x_jq)) * stress;
  };
  add(fluid.node[q.owner], fluid.stress[q.owner]);
  for (const std::uint32_t j : search.fluid_near_fluid(q.owner))
    add(fluid.node[j], fluid.stress[search.halo().particle(j, fluid)]);
  for (const std::uint32_t w : search.boundary_near_fluid(q.owner))
    add(boundary.node()[w], boundary.stress[w]);
  return sum;
}

// sum_q W_q sigma_q grad N_i(x_q)/V_i over the points of a particle, at x from where they stand.
template <int Dim>
Vec<Dim> BackgroundCells<Dim>::flux(std::size_t owner, const Vec<Dim>& x) const {
  Vec<Dim> sum = Vec<Dim>::Zero();
  for (std::uint32_t n = first_[owner]; n < first_[owner + 1]; ++n) {
    const Point& q = point_[n];
    const Vec<Dim> x_iq = x - q.x;
    if (!is_seen(kernel_, x_iq)) continue;
    sum += kernel_.value(x_iq) * (q.s + q.S * x_iq);
  }
  return sum;
}

template <int Dim>
void BackgroundCells<Dim>::compute(const NeighborSearch<Dim>& search, const BoundaryParticles<Dim>& boundary,
                                   const Parallel& parallel, Particles<Dim>& fluid) {
  spread_volumes(fluid);
  sort_by_owner(fluid.size());
  parallel.for_each(point_.size(), [&](std::size_t n) { find_stress(search, boundary, fluid, point_[n]); });
  force_.resize(fluid.size());
  parallel.for_each(fluid.size(), [&](std::size_t i) {
    Vec<Dim> sum = flux(i, fluid.node[i].x);
    for (const std::uint32_t k : search.fluid_near_fluid(i))
      sum += flux_of(search, fluid, k, fluid.node[i].x);
    force_[i] = -fluid.node[i].volume * sum;
    fluid.source[i].s.setZero();
    fluid.source[i].S.setZero();
  });
}

// The same of what may be an image, whose points stand beside it as those of the original do.
template <int Dim>
Vec<Dim> BackgroundCells<Dim>::flux_of(const NeighborSearch<Dim>& search, const Particles<Dim>& fluid,
                                       std::size_t k, const Vec<Dim>& x) const {
  const std::size_t original = search.halo().particle(k, fluid);
  return flux(original, x - (fluid.node[k].x - fluid.node[original].x));
}

template <int Dim>
void BackgroundCells<Dim>::accelerate(const Parallel& parallel, Particles<Dim>& fluid) const {
  parallel.for_each(fluid.size(), [&](std::size_t i) { fluid.acceleration[i] += force_[i] / fluid.mass[i]; });
}

template <int Dim>
void BackgroundCells<Dim>::react(const NeighborSearch<Dim>& search, const BoundaryParticles<Dim>& boundary,
                                 const Parallel& parallel, const Particles<Dim>& fluid,
                                 std::vector<Reaction<Dim>>& reaction) const {
  const auto& active = search.active_boundary();
  parallel.for_each(active.size(), [&](std::size_t a) {
    const Node<Dim>& w = boundary.node()[active[a]];
    for (const std::uint32_t k : search.fluid_near_active(a))
      reaction[active[a]].force -= w.volume * flux_of(search, fluid, k, w.x);
  });
}

template class BackgroundCells<2>;
template class BackgroundCells<3>;

}  // namespace sluice::fluid
