#include "fluid/openings.hpp"

#include <algorithm>
#include <cmath>

#include "fluid/lattice.hpp"

namespace sluice::fluid {

namespace {

// Beyond its end by this much of a spacing a buffer's particle has left: more than rounding.
constexpr double kTolerance = 1e-3;
// Fluid is taken back into an inflow's buffer this many spacings behind the plane, so that what comes in does
// not go to and fro.
constexpr double kHold = 0.5;

}  // namespace

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

template <int Dim>
void Openings<Dim>::add(Particles<Dim>& fluid, std::size_t gate, const Node<Dim>& node, double mass) {
  fluid.mass.push_back(mass);
  fluid.node.push_back(node);
  fluid.acceleration.push_back(Vec<Dim>::Zero());
  fluid.density_rate.push_back(0.0);
  fluid.id.push_back(next_id_++);
  fluid.opening.push_back(static_cast<std::uint8_t>(gate + 1));
}

template <int Dim>
void Openings<Dim>::fill(Particles<Dim>& fluid) {
  if (!is_used()) return;
  next_id_ = static_cast<std::uint32_t>(fluid.size());
  fluid.opening.assign(fluid.size(), 0);
  for (std::size_t g = 0; g < gates_.size(); ++g)
    gates_[g].given.inflow ? fill_inflow(fluid, g) : fill_outflow(fluid, g);
  fluid.divergence.resize(fluid.size());
  if (!fluid.L.empty()) fluid.L.resize(fluid.size());
}

template <int Dim>
void Openings<Dim>::fill_inflow(Particles<Dim>& fluid, std::size_t g) {
  const Gate& gate = gates_[g];
  const double spacing = gate.cell[gate.axis];
  for (std::size_t c = 0; c < gate.columns(); ++c) {
    Column& column = column_[gate.first + c];
    column.rho = eos_.rest_density();
    column.way = (static_cast<double>(gate.layers) + 0.5) * spacing;
  }
  feed(fluid, g);
}

// The mirror image of the fluid beside it, moving on.
template <int Dim>
void Openings<Dim>::fill_outflow(Particles<Dim>& fluid, std::size_t g) {
  const Gate& gate = gates_[g];
  for (std::size_t i = 0, count = fluid.size(); i < count; ++i) {
    if (fluid.opening[i] != 0) continue;
    Node<Dim> node = fluid.node[i];
    const double distance = gate.distance(node.x);
    if (!(distance >= 0.0 && distance < gate.depth() && gate.is_across(node.x, 0.0))) continue;
    node.x -= 2.0 * distance * gate.normal();
    add(fluid, g, node, fluid.mass[i]);
  }
}

template <int Dim>
void Openings<Dim>::advance(double dt) {
  time_ += dt;
  for (const Gate& gate : gates_)
    for (std::size_t c = gate.first; c < gate.first + gate.columns(); ++c)
      column_[c].way += dt * gate.normal().dot(column_[c].velocity);
}

template <int Dim>
void Openings<Dim>::exchange(Particles<Dim>& fluid) {
  if (!is_used()) return;
  Halo<Dim>::remove(fluid);
  for (std::size_t i = 0; i < fluid.size(); ++i) cross(fluid, i);
  remove_left(fluid);
  find_newest(fluid);
  for (std::size_t g = 0; g < gates_.size(); ++g)
    if (gates_[g].given.inflow) feed(fluid, g);
  fluid.divergence.resize(fluid.size());
  if (!fluid.L.empty()) fluid.L.resize(fluid.size());
}

template <int Dim>
void Openings<Dim>::cross(Particles<Dim>& fluid, std::size_t i) {
  const Vec<Dim>& x = fluid.node[i].x;
  if (fluid.opening[i] != 0) {
    const std::size_t g = fluid.opening[i] - 1u;
    if (gates_[g].distance(x) < 0.0) return;
    fluid.opening[i] = 0;
    return count(fluid, i, g, 1.0);
  }
  for (std::size_t g = 0; g < gates_.size(); ++g) {
    const Gate& gate = gates_[g];
    const double distance = gate.distance(x);
    if (distance >= (gate.given.inflow ? -kHold * spacing_ : 0.0) || !gate.is_across(x, kHold * spacing_))
      continue;
    if (gate.given.inflow && !is_wet(gate, gate.column(x)) && distance >= -gate.depth()) continue;
    fluid.opening[i] = static_cast<std::uint8_t>(g + 1);
    return count(fluid, i, g, -1.0);
  }
}

template <int Dim>
void Openings<Dim>::count(const Particles<Dim>& fluid, std::size_t i, std::size_t gate, double sign) {
  const Node<Dim>& node = fluid.node[i];
  (sign > 0.0 ? passage_[gate].mass_in : passage_[gate].mass_out) += fluid.mass[i];
  work_ += sign * fluid.mass[i] *
           (0.5 * node.v.squaredNorm() - gravity_.dot(node.x) + eos_.elastic_energy(node.rho));
}

template <int Dim>
bool Openings<Dim>::has_left(const Particles<Dim>& fluid, std::size_t i) const {
  if (fluid.opening[i] == 0) return false;
  const Gate& gate = gates_[fluid.opening[i] - 1u];
  return gate.distance(fluid.node[i].x) < -gate.depth() - kTolerance * spacing_;
}

template <int Dim>
void Openings<Dim>::remove_left(Particles<Dim>& fluid) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < fluid.size(); ++i) {
    if (has_left(fluid, i)) continue;
    if (kept != i) {
      fluid.mass[kept] = fluid.mass[i];
      fluid.node[kept] = fluid.node[i];
      fluid.acceleration[kept] = fluid.acceleration[i];
      fluid.density_rate[kept] = fluid.density_rate[i];
      fluid.id[kept] = fluid.id[i];
      fluid.opening[kept] = fluid.opening[i];
    }
    ++kept;
  }
  fluid.mass.resize(kept);
  fluid.node.resize(kept);
  fluid.acceleration.resize(kept);
  fluid.density_rate.resize(kept);
  fluid.id.resize(kept);
  fluid.opening.resize(kept);
}

// Where there was backflow, the lattice does not stand where it did.
template <int Dim>
void Openings<Dim>::find_newest(const Particles<Dim>& fluid) {
  std::vector<bool> is_found(column_.size(), false);
  for (std::size_t i = 0; i < fluid.size(); ++i) {
    if (fluid.opening[i] == 0) continue;
    const Gate& gate = gates_[fluid.opening[i] - 1u];
    const std::size_t c = gate.first + gate.column(fluid.node[i].x);
    const double way = gate.distance(fluid.node[i].x) + gate.depth();
    column_[c].way = is_found[c] ? std::min(column_[c].way, way) : way;
    is_found[c] = true;
  }
}

// The lattice of an inflow goes on at the buffer's outer end.
template <int Dim>
void Openings<Dim>::feed(Particles<Dim>& fluid, std::size_t g) {
  const Gate& gate = gates_[g];
  const double spacing = gate.cell[gate.axis];
  for (std::size_t c = 0; c < gate.columns(); ++c) {
    Column& column = column_[gate.first + c];
    while (column.way >= spacing) {
      column.way -= spacing;
      if (!is_wet(gate, c)) continue;
      const Vec<Dim> x = gate.foot(c) + (column.way - gate.depth()) * gate.normal();
      add(fluid, g, {x, column.velocity, volume_, column.rho}, column.rho * volume_);
    }
  }
}

template class Openings<2>;
template class Openings<3>;

}  // namespace sluice::fluid
