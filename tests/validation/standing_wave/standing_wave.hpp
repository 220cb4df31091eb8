#pragma once

#include "validation/support/case.hpp"

namespace sluice::validation {

Case standing_wave();
Case viscous_standing_wave();

}  // namespace sluice::validation
