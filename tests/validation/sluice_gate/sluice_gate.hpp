#pragma once

#include "validation/support/case.hpp"

namespace sluice::validation {

// Steady flow under a gate, from an inflow that holds the water in front: discharge and contraction against
// the textbook. A resolution counts particles over the gate's opening.
Case sluice_gate();

}  // namespace sluice::validation
