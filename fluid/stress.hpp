#pragma once

#include "fluid/particles.hpp"

namespace sluice::fluid {

// Symmetric part of the velocity gradient, CF (61).
template <int Dim>
Mat<Dim> strain_rate(const Mat<Dim>& L) {
  return 0.5 * (L + L.transpose());
}

// Viscous stress 2 mu d' of a Newtonian liquid, CF (60)-(61). d' = d - tr(d)/3 I also in two dimensions,
// where it is the in-plane part of a flow without strain along z.
template <int Dim>
Mat<Dim> viscous_stress(double mu, const Mat<Dim>& d) {
  return 2.0 * mu * (d - d.trace() / 3.0 * Mat<Dim>::Identity());
}

// s = V sigma g and S = V sigma G, all that the force sweep needs of a particle's stress.
template <int Dim>
void set_source(double volume, const Mat<Dim>& sigma, const Fit<Dim>& fit, Source<Dim>& source) {
  source.s = volume * (sigma * fit.g);
  source.S = volume * (sigma * fit.G);
}

// The same of a pressure alone, V sigma = V_sigma I.
template <int Dim>
void set_source(double V_sigma, const Fit<Dim>& fit, Source<Dim>& source) {
  source.s = V_sigma * fit.g;
  source.S = V_sigma * fit.G;
}

}  // namespace sluice::fluid
