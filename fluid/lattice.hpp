#pragma once

#include "fluid/moments.hpp"
#include "fluid/types.hpp"

namespace sluice::fluid {

// Eigenvalue [m^2] of the centred second moment C on the undisturbed cubic lattice of spacing dx: the scale
// of the floor, and the inverse of the G that boundary particles use.
template <int Dim, typename Kernel>
double lattice_moment(const Kernel& kernel, double spacing) {
  const int reach = static_cast<int>(kernel.support() / spacing) + 1;
  const double volume = Dim == 2 ? spacing * spacing : spacing * spacing * spacing;
  double sum = 0;
  for (int a = -reach; a <= reach; ++a)
    for (int b = -reach; b <= reach; ++b)
      for (int c = Dim == 3 ? -reach : 0; c <= (Dim == 3 ? reach : 0); ++c) {
        Vec<Dim> x;
        x[0] = a * spacing;
        x[1] = b * spacing;
        if constexpr (Dim == 3) x[2] = c * spacing;
        sum += volume * kernel.value(x) * x[0] * x[0];
      }
  return sum;
}

}  // namespace sluice::fluid
