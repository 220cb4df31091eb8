#pragma once

#include "fluid/kernel.hpp"
#include "fluid/moments.hpp"

namespace sluice::fluid {

// Eigenvalue [m^2] of the centred second moment C on the undisturbed cubic lattice of spacing dx: the scale
// of the floor, and the inverse of the G that boundary particles use.
template <int Dim>
double lattice_moment(const WendlandC2<Dim>& kernel, double spacing) {
  const int reach = static_cast<int>(kernel.support() / spacing) + 1;
  const double volume = Dim == 2 ? spacing * spacing : spacing * spacing * spacing;
  double sum = 0;
  for (int a = -reach; a <= reach; ++a)
    for (int b = -reach; b <= reach; ++b)
      for (int c = Dim == 3 ? -reach : 0; c <= (Dim == 3 ? reach : 0); ++c) {
        const double x = a * spacing, y = b * spacing, z = c * spacing;
        sum += volume * kernel.value(x * x + y * y + z * z) * x * x;
      }
  return sum;
}

}  // namespace sluice::fluid
