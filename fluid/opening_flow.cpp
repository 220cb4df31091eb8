// What openings give to their buffers, and take from the flow.

#include <algorithm>
#include <cmath>

#include "fluid/extrapolation.hpp"
#include "fluid/openings.hpp"

namespace sluice::fluid {

namespace {

// The kernel sum of the fluid in front of an opening, one half where it is full, from which on all that the
// buffer has is the flow's.
constexpr double kEnough = 0.1;

}  // namespace

template <int Dim>
void Openings<Dim>::list(const Particles<Dim>& fluid) {
  beside_ = near_ = pairs_ = {{0}, {}};
  touching_.clear();
  const double reach = support_ + skin_;
  for (std::size_t g = 0; g < gates_.size(); ++g) {
    const Gate& gate = gates_[g];
    std::vector<Node<Dim>> nodes;
    for (std::uint32_t i = 0; i < fluid.size(); ++i) {
      const Vec<Dim>& x = fluid.node[i].x;
      const double distance = gate.distance(x);
      if (fluid.opening[i] != 0 || distance <= -reach || distance >= 2.0 * support_ + skin_ ||
          !gate.is_across(x, reach))
        continue;
      beside_.index.push_back(i);
      nodes.push_back(fluid.node[i]);
    }
    CellGrid<Dim> cells(nodes, reach);
    cells.file(nodes);
    const std::uint32_t* const particle = beside_.index.data() + beside_.begin.back();
    const auto append_near = [&](const Vec<Dim>& x, NeighborList& list) {
      const Vec<Dim> low = x.array() - reach, high = x.array() + reach;
      cells.for_rows_in(low, high, [&](std::uint32_t first, std::uint32_t last) {
        for (std::uint32_t k = first; k < last; ++k) {
          const std::uint32_t item = cells.item()[k];
          if ((nodes[item].x - x).squaredNorm() < reach * reach) list.index.push_back(particle[item]);
        }
      });
      list.begin.push_back(list.index.size());
    };
    for (std::size_t c = 0; c < gate.columns(); ++c) append_near(gate.foot(c), near_);
    for (std::uint32_t b = 0; b < fluid.size(); ++b) {
      if (fluid.opening[b] != g + 1 || gate.distance(fluid.node[b].x) <= -reach) continue;
      touching_.push_back(b);
      append_near(fluid.node[b].x, pairs_);
    }
    beside_.begin.push_back(beside_.index.size());
  }
}

// Calls visit(i, gate, foot, column) for all buffer particles.
template <int Dim>
template <typename Visit>
void Openings<Dim>::for_buffers(const Particles<Dim>& fluid, const Parallel& parallel, const Visit& visit) {
  parallel.for_each(fluid.size(), [&](std::size_t i) {
    if (fluid.opening[i] == 0) return;
    const Gate& gate = gates_[fluid.opening[i] - 1u];
    const std::size_t c = gate.column(fluid.node[i].x);
    visit(i, gate, gate.foot(c), column_[gate.first + c]);
  });
}

template <int Dim>
void Openings<Dim>::impose_velocity(double dt, Particles<Dim>& fluid, const Parallel& parallel) {
  if (!is_used()) return;
  for (std::size_t g = 0; g < gates_.size(); ++g) find_velocity(g, dt, fluid, parallel);
  for_buffers(fluid, parallel, [&](std::size_t i, const Gate& gate, const Vec<Dim>&, const Column& column) {
    Vec<Dim>& v = fluid.node[i].v;
    v += column.share * (column.velocity - v);
    if (!gate.given.inflow) v -= std::max(0.0, v.dot(gate.normal())) * gate.normal();
  });
}

template <int Dim>
void Openings<Dim>::find_velocity(std::size_t g, double dt, const Particles<Dim>& fluid,
                                  const Parallel& parallel) {
  const Gate& gate = gates_[g];
  if (!gate.given.inflow) {
    parallel.for_each(gate.columns(), [&](std::size_t c) { take_velocity(gate, fluid, c); });
    return;
  }
  const double held = gate.takes_velocity() ? hold_level(g, dt, fluid) : 0.0;
  for (std::size_t c = 0; c < gate.columns(); ++c) {
    Column& column = column_[gate.first + c];
    column.velocity =
        (gate.given.speed ? gate.given.speed(time_, widen<Dim>(gate.foot(c))) : held) * gate.normal();
    column.share = 1.0;
  }
}

// The speed [m/s] of what comes in at a given level, depth d0. Waves on the liquid in front leave the tank
// through the opening: along them u + 2 sqrt(g d) is the same on both sides (simple wave of shallow water),
//   u = u0 + 2 (sqrt(g d0) - sqrt(g d)),
// with the measured depth d, of which what changes faster than d0 / (2 sqrt(g d0)) is left out, and u0, which
// follows u slowly, in 16 d0 / sqrt(g d0), so that d becomes d0.
template <int Dim>
double Openings<Dim>::hold_level(std::size_t g, double dt, const Particles<Dim>& fluid) {
  const Gate& gate = gates_[g];
  Hold& hold = hold_[g];
  const Vec<Dim> max = narrow<Dim>(gate.given.max);
  const double bottom = std::max({1e-300, head(gate, gate.min), head(gate, max)});  // g d0
  const double wave = std::sqrt(bottom), time = bottom / gravity_.norm() / wave;
  const double depth = water_depth(g, fluid);
  if (dt == 0.0) hold = {depth, mean_speed(g, fluid)};
  hold.depth += std::min(1.0, dt / (0.5 * time)) * (depth - hold.depth);
  const double speed = hold.speed + 2.0 * (wave - std::sqrt(gravity_.norm() * std::max(0.0, hold.depth)));
  hold.speed += std::min(1.0, dt / (16.0 * time)) * (speed - hold.speed);
  return speed;
}

// Of the liquid in front of the opening [m]: its volume with the weight 30 u^2 (1 - u)^2 within two supports
// from the plane, smooth so that it does not matter where in it the particles stand.
template <int Dim>
double Openings<Dim>::water_depth(std::size_t g, const Particles<Dim>& fluid) const {
  const Gate& gate = gates_[g];
  double volume = 0;
  for (const std::uint32_t i : beside_.of(g)) {
    const Node<Dim>& node = fluid.node[i];
    const double u = gate.distance(node.x) / (2.0 * support_);
    if (u > 0.0 && u < 1.0 && gate.is_across(node.x, 0.0))
      volume += 30.0 * u * u * (1.0 - u) * (1.0 - u) * node.volume;
  }
  const Vec<Dim> size = narrow<Dim>(gate.given.max) - gate.min;
  const double height = std::abs(gravity_.normalized().dot(size));
  double area = 1;
  for (int a = 0; a < Dim; ++a)
    if (a != gate.axis) area *= size[a];
  return volume / (2.0 * support_) * height / area;
}

// Into the tank [m/s], of the fluid at the opening.
template <int Dim>
double Openings<Dim>::mean_speed(std::size_t g, const Particles<Dim>& fluid) const {
  const Gate& gate = gates_[g];
  double volume = 0, flow = 0;
  for (const std::uint32_t i : beside_.of(g)) {
    const Node<Dim>& node = fluid.node[i];
    if (!gate.is_across(node.x, 0.0)) continue;
    volume += node.volume;
    flow += node.volume * node.v.dot(gate.normal());
  }
  return volume > 0.0 ? flow / volume : 0.0;
}

// A linear fit along the plane, constant across it.
template <int Dim>
void Openings<Dim>::take_velocity(const Gate& gate, const Particles<Dim>& fluid, std::size_t c) {
  const Vec<Dim> foot = gate.foot(c);
  Extrapolation<Dim, Dim> flow;
  for (const std::uint32_t f : near_.of(gate.first + c)) {
    const Vec<Dim> x = fluid.node[f].x - foot;
    flow.add(kernel_.value(x), x, fluid.node[f].v);
  }
  Column& column = column_[gate.first + c];
  column.share = std::min(1.0, flow.weight() * volume_ / kEnough);
  if (flow.empty()) return;
  Vec<Dim> along = flow.centroid();
  along[gate.axis] = 0.0;
  column.velocity = flow.mean() - flow.slope(moment_floor_) * along;
}

template <int Dim>
void Openings<Dim>::impose_density(Particles<Dim>& fluid, const Parallel& parallel) {
  if (!is_used()) return;
  for (std::size_t g = 0; g < gates_.size(); ++g) find_density(g, fluid, parallel);
  const Vec<Dim> slope =
      eos_.rest_density() / (eos_.sound_speed() * eos_.sound_speed()) * gravity_;  // of rho at rest
  for_buffers(fluid, parallel,
              [&](std::size_t i, const Gate& gate, const Vec<Dim>& foot, const Column& column) {
                double& rho = fluid.node[i].rho;
                const double taken = std::max(column.rho + slope.dot(fluid.node[i].x - foot),
                                              std::min(column.rho, eos_.rest_density()));
                rho += (gate.takes_density() ? column.share : 1.0) * (taken - rho);
                if (gate.given.inflow) fluid.mass[i] = rho * volume_;
              });
}

template <int Dim>
void Openings<Dim>::find_density(std::size_t g, const Particles<Dim>& fluid, const Parallel& parallel) {
  const Gate& gate = gates_[g];
  if (gate.takes_density()) {
    parallel.for_each(gate.columns(), [&](std::size_t c) { take_density(gate, fluid, c); });
    return;
  }
  for (std::size_t c = 0; c < gate.columns(); ++c) {
    const Vec<Dim> foot = gate.foot(c);
    column_[gate.first + c].rho = gate.given.level
                                      ? eos_.hydrostatic_density(std::max(0.0, head(gate, foot)))
                                      : eos_.density(gate.given.pressure(time_, widen<Dim>(foot)));
  }
}

// The same fit of the density, with its gradient at rest across the plane. A buffer does not pull.
template <int Dim>
void Openings<Dim>::take_density(const Gate& gate, const Particles<Dim>& fluid, std::size_t c) {
  const Vec<Dim> foot = gate.foot(c);
  const double slope = eos_.rest_density() / (eos_.sound_speed() * eos_.sound_speed()) * gravity_[gate.axis];
  Extrapolation<Dim, 1> density;
  for (const std::uint32_t f : near_.of(gate.first + c)) {
    const Vec<Dim> x = fluid.node[f].x - foot;
    density.add(kernel_.value(x), x, Eigen::Matrix<double, 1, 1>(fluid.node[f].rho - slope * x[gate.axis]));
  }
  if (density.empty()) return;
  Vec<Dim> along = density.centroid();
  along[gate.axis] = 0.0;
  column_[gate.first + c].rho =
      std::max(eos_.rest_density(), (density.mean() - density.slope(moment_floor_) * along)[0]);
}

template <int Dim>
void Openings<Dim>::stop_acceleration(Particles<Dim>& fluid, const Parallel& parallel) const {
  parallel.for_each(fluid.size(), [&](std::size_t i) {
    if (fluid.opening[i] != 0) fluid.acceleration[i].setZero();
  });
}

template <int Dim>
void Openings<Dim>::count_work(double dt, double power) {
  work_ += 0.5 * dt * (power_ + power);
  power_ = power;
}

template class Openings<2>;
template class Openings<3>;

}  // namespace sluice::fluid
