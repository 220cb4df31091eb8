#pragma once

#include "fluid/moments.hpp"
#include "fluid/types.hpp"

namespace sluice::fluid {

// Sum of term(V, x) over the undisturbed cubic lattice of spacing dx around one of its points.
template <int Dim, typename Kernel, typename Term>
double sum_on_lattice(const Kernel& kernel, double spacing, const Term& term) {
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
        sum += term(volume, x);
      }
  return sum;
}

// Sum of V W there [-]: near one.
template <int Dim, typename Kernel>
double lattice_sum(const Kernel& kernel, double spacing) {
  return sum_on_lattice<Dim>(kernel, spacing,
                             [&](double V, const Vec<Dim>& x) { return V * kernel.value(x); });
}

// Eigenvalue [m^2] of the centred second moment C there: the scale of the floor, and the inverse of the G
// that boundary particles use.
template <int Dim, typename Kernel>
double lattice_moment(const Kernel& kernel, double spacing) {
  return sum_on_lattice<Dim>(kernel, spacing,
                             [&](double V, const Vec<Dim>& x) { return V * kernel.value(x) * x[0] * x[0]; });
}

// The same with F = -W'/r in the place of W [-]: near one.
template <int Dim, typename Kernel>
double lattice_slope(const Kernel& kernel, double spacing) {
  return sum_on_lattice<Dim>(kernel, spacing, [&](double V, const Vec<Dim>& x) {
    return V * kernel.value_and_slope(x).f * x[0] * x[0];
  });
}

}  // namespace sluice::fluid
