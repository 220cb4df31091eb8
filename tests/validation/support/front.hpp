#pragma once

#include <vector>

namespace sluice::validation {

// The foremost of particles that have come so far: where they are first a particle deep over four spacings,
// seen from ahead. Single particles of spray that run ahead of the tongue do not count.
double front_of(std::vector<double> way, double spacing);

}  // namespace sluice::validation
