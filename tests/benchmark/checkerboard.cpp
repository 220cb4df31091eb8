#include <algorithm>
#include <cmath>
#include <limits>

#include "benchmark/checks.hpp"
#include "benchmark/lattice.hpp"

namespace sluice::benchmark {

namespace {

using Eigen::Vector3d;

struct Pattern {
  std::string name;
  Vector3d (*velocity)(int column, int row);  // of length 1
};

double sign(int n) {
  return n % 2 == 0 ? 1 : -1;
}

const std::vector<Pattern>& patterns() {
  static const std::vector<Pattern> all{
      {"checkerboard", [](int column, int row) { return Vector3d(sign(column + row), 0, 0); }},
      {"rows that slide", [](int, int row) { return Vector3d(sign(row), 0, 0); }},
      {"columns that meet", [](int column, int) { return Vector3d(sign(column), 0, 0); }}};
  return all;
}

// Rate [c0/h] at which the pattern's amplitude grows: the slope of the logarithm of the square root of the
// kinetic energy between 10 and 50 h/c0, when what dissipation takes away at once is gone.
double growth(const Pattern& pattern, const fluid::Formulation& formulation) {
  constexpr int kCells = 24;
  constexpr double kAmplitude = 1e-5;     // over c0: particles move by 1e-3 h at most
  constexpr double kFrom = 10, kTo = 50;  // [h/c0]
  Lattice lattice(kCells);
  lattice.setup.formulation = formulation;
  lattice.for_each([&](const Vector3d& x, int column, int row) {
    lattice.add(x, kAmplitude * Lattice::kSoundSpeed * pattern.velocity(column, row), Lattice::kPressure);
  });
  const auto solver = fluid::make_solver(lattice.setup);
  solver->start({});
  const double unit = lattice.h() / Lattice::kSoundSpeed;
  const int steps = static_cast<int>(std::ceil(kTo * unit / solver->largest_step(0)));
  const double dt = kTo * unit / steps;
  const int first = static_cast<int>(kFrom * unit / dt);
  double at_first = 0;
  for (int k = 1; k <= steps; ++k) {
    solver->step(dt, {});
    if (k == first) at_first = solver->diagnostics().kinetic;
  }
  return 0.5 * std::log(solver->diagnostics().kinetic / at_first) / (dt * (steps - first) / unit);
}

}  // namespace

StabilityTable checkerboard(const StabilityOptions&) {
  StabilityTable table{.name = "checkerboard",
                       .title =
                           "Velocity that alternates on a lattice under the pressure of 1 % of rho c0^2: "
                           "growth of its amplitude",
                       .items = "pattern",
                       .columns = {{"defaults", "c0/h"}, {"no dissipation", "c0/h"}, {"shifting 6", "c0/h"}},
                       .rows = {},
                       .figures = {}};
  fluid::Formulation without, shifted;
  without.artificial_viscosity = without.density_diffusion = 0;
  shifted.shifting = 6;
  double largest = -std::numeric_limits<double>::infinity();
  for (const Pattern& pattern : patterns()) {
    const double rate = growth(pattern, {});
    table.rows.push_back({pattern.name, {rate, growth(pattern, without), growth(pattern, shifted)}, ""});
    largest = std::max(largest, rate);
  }
  table.figures = {{"fastest growth at the defaults", "c0/h", largest, 0}};
  return table;
}

}  // namespace sluice::benchmark
