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

// Rate [c0/h] at which the pattern's amplitude grows. A stable lattice swings: the largest kinetic energy of
// the second half of the run is set against that of the first, both longer than a swing.
double growth(const Pattern& pattern, const fluid::Formulation& formulation) {
  constexpr int kCells = 24;
  constexpr double kAmplitude = 1e-5;  // over c0
  constexpr double kHalf = 200;        // [h/c0]
  Lattice lattice(kCells);
  lattice.setup.formulation = formulation;
  lattice.for_each([&](const Vector3d& x, int column, int row) {
    lattice.add(x, kAmplitude * Lattice::kSoundSpeed * pattern.velocity(column, row), Lattice::kPressure);
  });
  const auto solver = fluid::make_solver(lattice.setup);
  solver->start({});
  const double half = kHalf * lattice.h() / Lattice::kSoundSpeed;
  const int steps = static_cast<int>(std::ceil(half / solver->largest_step(0)));
  const auto largest = [&] {
    double kinetic = 0;
    for (int k = 0; k < steps; ++k) {
      solver->step(half / steps, {});
      kinetic = std::max(kinetic, solver->diagnostics().kinetic);
    }
    return kinetic;
  };
  const double first = largest(), second = largest();
  return 0.5 * std::log(second / first) / kHalf;
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
