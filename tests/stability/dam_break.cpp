#include "tests/stability/dam_break.hpp"

#include <algorithm>
#include <cmath>
#include <ostream>

#include "fluid/equation_of_state.hpp"
#include "fluid/sampling.hpp"

namespace sluice::fluid {

namespace {

using Eigen::Vector3d;

void add_column(const DamBreak& dam, Setup& setup) {
  const int up = dam.dimension - 1;
  Vector3d size(dam.width, dam.width, 0);
  size[up] = 2.0 * dam.width;
  const EquationOfState eos(setup.liquid.density, setup.liquid.sound_speed);
  for (const Vector3d& x : fill(BoxShape{size / 2}, size / 2, setup.spacing, dam.dimension)) {
    setup.fluid.position.push_back(x);
    setup.fluid.velocity.push_back(Vector3d::Zero());
    setup.fluid.pressure.push_back(eos.pressure(eos.hydrostatic_density(dam.gravity * (size[up] - x[up]))));
  }
  setup.fluid.volume = particle_volume(setup.spacing, dam.dimension);
}

double mechanical_energy(const Diagnostics& d) {
  return d.kinetic + d.potential + d.elastic;
}

void follow(const DamBreak& dam, const Snapshot& snapshot, Extremes& extremes) {
  const int up = dam.dimension - 1;
  for (std::size_t i = 0; i < snapshot.density.size(); ++i) {
    const double* x = &snapshot.position[3 * i];
    if (x[up] > dam.height()) continue;  // over the rim it may go anywhere
    double beyond = std::max({-x[up], -x[0], x[0] - dam.length()});
    if (dam.dimension == 3) beyond = std::max({beyond, -x[1], x[1] - dam.width});
    extremes.escape = std::max(extremes.escape, beyond / dam.spacing());
    extremes.farthest_x = std::max(extremes.farthest_x, x[0] / dam.length());
  }
}

}  // namespace

double DamBreak::largest_speed() const {
  return std::sqrt(2.0 * gravity * 2.0 * width);
}

double DamBreak::end_time() const {
  return 8.0 / std::sqrt(2.0 * gravity / width);
}

Setup DamBreak::setup() const {
  Setup s;
  s.dimension = dimension;
  s.spacing = spacing();
  s.gravity[dimension - 1] = -gravity;
  s.liquid = {1000, 0, 10.0 * largest_speed()};
  s.formulation.artificial_viscosity = viscosity;
  add_column(*this, s);
  const Vector3d tank =
      dimension == 2 ? Vector3d(length(), height(), 0) : Vector3d(length(), width, height());
  const std::array<bool, 6> closed{true, true, true, dimension == 3, true, false};
  const double support = 2.0 * s.formulation.smoothing * s.spacing;
  s.walls = sample_walls({Vector3d(0, 0, 0), tank, closed}, s.spacing, support, dimension);
  return s;
}

std::ostream& operator<<(std::ostream& out, const DamBreak& dam) {
  return out << "Dimension" << dam.dimension << "Cells" << dam.cells << "Alpha"
             << std::lround(1000 * dam.viscosity);
}

Extremes run(const DamBreak& dam) {
  const auto solver = make_solver(dam.setup());
  solver->start({});
  const double dt = solver->largest_step(dam.largest_speed());
  const int steps = static_cast<int>(dam.end_time() / dt);
  const double first = mechanical_energy(solver->diagnostics());
  double lowest = first;
  Extremes extremes;
  for (int k = 1; k <= steps && extremes.finite; ++k) {
    solver->step(dt, {});
    const Diagnostics now = solver->diagnostics();
    const double energy = mechanical_energy(now);
    extremes.finite = std::isfinite(energy);
    extremes.compression = std::max(extremes.compression, now.max_compression);
    extremes.energy_rise = std::max(extremes.energy_rise, (energy - lowest) / first);
    lowest = std::min(lowest, energy);
    if (k % 10 == 0) follow(dam, solver->snapshot(), extremes);
  }
  return extremes;
}

}  // namespace sluice::fluid
