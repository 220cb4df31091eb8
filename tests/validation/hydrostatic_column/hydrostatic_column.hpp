#pragma once

#include "validation/support/case.hpp"

namespace sluice::validation {

Case hydrostatic_column();

}  // namespace sluice::validation
