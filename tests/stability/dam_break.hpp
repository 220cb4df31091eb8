#pragma once

#include <iosfwd>

#include "fluid/solver.hpp"

namespace sluice::fluid {

// A column of water, `width` wide and twice as high, against the left wall of an open tank 5.4 widths long
// and 6 high. In space the column and the tank are one width deep. Up is y in the plane, z in space.
struct DamBreak {
  int dimension = 2;
  int cells = 12;         // particles over the width of the column
  double viscosity = 0;   // artificial, alpha
  double width = 0.1;     // a [m]
  double gravity = 9.81;  // [m/s^2]

  [[nodiscard]] double spacing() const { return width / cells; }
  [[nodiscard]] double length() const { return 5.4 * width; }  // of the tank [m]
  [[nodiscard]] double height() const { return 6.0 * width; }
  [[nodiscard]] double largest_speed() const;  // of a particle that falls from the column's top [m/s]
  [[nodiscard]] double end_time() const;       // t sqrt(2 g/a) = 8: long after the impact on the far wall
  [[nodiscard]] Setup setup() const;
};

std::ostream& operator<<(std::ostream& out, const DamBreak& dam);

// What must stay bounded during a run. Distances in spacings, energies over that of the start.
struct Extremes {
  double compression = 0;  // largest |rho/rho0 - 1|
  double energy_rise = 0;  // of kinetic + potential + elastic over its lowest value so far
  double escape = 0;       // farthest beyond the floor or a side wall, below the tank's rim
  double farthest_x = 0;   // share of the tank's length that the front has reached
  bool finite = true;
};

// Runs to the end, or until the state is no longer finite.
Extremes run(const DamBreak& dam);

}  // namespace sluice::fluid
