#pragma once

#include "fluid/setup.hpp"

namespace sluice::fluid {

// Largest step [s] in which the free bodies may be advanced with the fluid's force of the step's ends;
// infinite without free bodies. A body that moves through liquid radiates sound, which resists with
// rho0 c0 A v on either side (A its largest cross-section), and the force that a step applies is that of its
// beginning: what the body gains in it must stay below a share of its momentum,
//   2 rho0 c0 A dt / m <= 1/2.
// Light bodies set the step of the run by it; the share is measured (tests/benchmark/README.md).
double largest_body_step(const Setup& setup);

// 2 rho0 c0 A of that body [kg/s], per metre of depth in two dimensions.
double body_impedance(const Setup& setup, std::size_t body);

}  // namespace sluice::fluid
