#pragma once

#include "validation/support/case.hpp"

namespace sluice::validation {

Case jet_on_wall();

}  // namespace sluice::validation
