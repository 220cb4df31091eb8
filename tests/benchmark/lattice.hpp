#pragma once

#include "fluid/solver.hpp"

namespace sluice::benchmark {

// A square lattice of liquid that fills a periodic square of 1 m at rest: its setup without particles, which
// are added one by one.
struct Lattice {
  static constexpr double kSoundSpeed = 10;                                         // [m/s]
  static constexpr double kDensity = 1000;                                          // [kg/m^3]
  static constexpr double kPressure = 0.01 * kDensity * kSoundSpeed * kSoundSpeed;  // [Pa]

  explicit Lattice(int cells_along) : cells(cells_along) {
    setup.spacing = 1.0 / cells;
    setup.period.length = {1, 1, 0};
    setup.liquid = {kDensity, 0, kSoundSpeed};
    setup.fluid.volume = setup.spacing * setup.spacing;
  }

  // Calls with every lattice point [m] and its column and row.
  template <typename Visitor>
  void for_each(const Visitor& visit) const {
    for (int row = 0; row < cells; ++row)
      for (int column = 0; column < cells; ++column)
        visit(Eigen::Vector3d(setup.spacing * (column + 0.5), setup.spacing * (row + 0.5), 0), column, row);
  }

  void add(const Eigen::Vector3d& position, const Eigen::Vector3d& velocity, double pressure) {
    setup.fluid.position.push_back(position);
    setup.fluid.velocity.push_back(velocity);
    setup.fluid.pressure.push_back(pressure);
  }

  [[nodiscard]] double h() const { return setup.formulation.smoothing * setup.spacing; }

  int cells;
  fluid::Setup setup;
};

}  // namespace sluice::benchmark
