#pragma once

#include "validation/support/case.hpp"

namespace sluice::validation {

// At density ratios of 2, 10 and 1000.
Case interfacial_wave_2();
Case interfacial_wave_10();
Case interfacial_wave_1000();

}  // namespace sluice::validation
