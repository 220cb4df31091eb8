#include "fluid/openings.hpp"

#include <algorithm>
#include <cmath>

#include "fluid/lattice.hpp"

namespace sluice::fluid {

template <int Dim>
Openings<Dim>::Openings(const Setup& setup, double support, double skin)
    : kernel_(setup.formulation.smoothing * setup.spacing),
      eos_(setup.liquid.density, setup.liquid.sound_speed),
      gravity_(narrow<Dim>(setup.gravity)),
      spacing_(setup.spacing),
      volume_(setup.fluid.volume),
      support_(support),
      skin_(skin),
      moment_floor_(setup.formulation.moment_floor * lattice_moment<Dim>(kernel_, setup.spacing)) {
  std::size_t columns = 0;
  for (const Opening& opening : setup.openings) {
    gates_.push_back(make_gate(opening));
    gates_.back().first = columns;
    columns += gates_.back().columns();
  }
  column_.resize(columns);
  passage_.resize(gates_.size());
  hold_.resize(gates_.size());
}

template <int Dim>
auto Openings<Dim>::make_gate(const Opening& opening) const -> Gate {
  Gate gate{.given = opening,
            .axis = opening.side / 2,
            .plane = opening.min[opening.side / 2],
            .inward = opening.side % 2 == 0 ? 1.0 : -1.0,
            .min = narrow<Dim>(opening.min),
            .cell = Vec<Dim>::Ones(),
            .cells = Eigen::Matrix<std::size_t, Dim, 1>::Ones(),
            .layers = 0,
            .first = 0};
  for (int a = 0; a < Dim; ++a) {
    if (a == gate.axis) continue;
    const double length = opening.max[a] - opening.min[a];
    gate.cells[a] = static_cast<std::size_t>(std::max(1L, std::lround(length / spacing_)));
    gate.cell[a] = length / static_cast<double>(gate.cells[a]);
  }
  gate.cell[gate.axis] = volume_ / gate.cell.prod();
  gate.layers = static_cast<std::size_t>(std::ceil((2.0 * support_ + skin_) / gate.cell[gate.axis]));
  return gate;
}

template <int Dim>
Vec<Dim> Openings<Dim>::Gate::foot(std::size_t column) const {
  Vec<Dim> x;
  for (int a = 0; a < Dim; ++a) {
    x[a] = a == axis ? plane : min[a] + (static_cast<double>(column % cells[a]) + 0.5) * cell[a];
    column /= cells[a];
  }
  return x;
}

template <int Dim>
std::size_t Openings<Dim>::Gate::column(const Vec<Dim>& x) const {
  std::size_t column = 0;
  for (int a = Dim - 1; a >= 0; --a) {
    const double place = a == axis ? 0.0 : (x[a] - min[a]) / cell[a];
    const double last = static_cast<double>(cells[a] - 1);
    column = column * cells[a] + (place > 0.0 ? static_cast<std::size_t>(std::min(place, last)) : 0);
  }
  return column;
}

template <int Dim>
bool Openings<Dim>::Gate::is_across(const Vec<Dim>& x, double margin) const {
  for (int a = 0; a < Dim; ++a) {
    if (a == axis) continue;
    const double max = min[a] + static_cast<double>(cells[a]) * cell[a];
    if (!(x[a] >= min[a] - margin && x[a] <= max + margin)) return false;
  }
  return true;
}

template <int Dim>
bool Openings<Dim>::is_inside(const Vec<Dim>& x) const {
  return std::all_of(gates_.begin(), gates_.end(), [&](const Gate& gate) { return gate.distance(x) >= 0.0; });
}

// The rate is the momentum of the buffer over its depth.
template <int Dim>
std::vector<Passage> Openings<Dim>::passages(const Particles<Dim>& fluid) const {
  std::vector<Passage> passages = passage_;
  for (std::size_t i = 0; i < fluid.size(); ++i) {
    if (fluid.opening[i] == 0) continue;
    const Gate& gate = gates_[fluid.opening[i] - 1u];
    passages[fluid.opening[i] - 1u].rate += fluid.mass[i] * fluid.node[i].v.dot(gate.normal()) / gate.depth();
  }
  return passages;
}

// Of liquid at rest up to the level [J/kg]; negative above.
template <int Dim>
double Openings<Dim>::head(const Gate& gate, const Vec<Dim>& x) const {
  return gravity_.norm() * gate.given.level(time_) + gravity_.dot(x);
}

// Whether liquid comes in through a column of an inflow.
template <int Dim>
bool Openings<Dim>::is_wet(const Gate& gate, std::size_t column) const {
  return !gate.given.level || head(gate, gate.foot(column)) > 0.0;
}

template class Openings<2>;
template class Openings<3>;

}  // namespace sluice::fluid
