// How particles come into the buffers, cross the planes of the openings and leave.

#include <algorithm>

#include "fluid/openings.hpp"

namespace sluice::fluid {

namespace {

// Beyond its end by this much of a spacing a buffer's particle has left: more than rounding.
constexpr double kTolerance = 1e-3;
// Fluid is taken back into an inflow's buffer this many spacings behind the plane, so that what comes in does
// not go to and fro.
constexpr double kHold = 0.5;

}  // namespace

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
