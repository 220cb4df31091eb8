#pragma once

#include "validation/support/case.hpp"

namespace sluice::validation {

Case drop_impact();

}  // namespace sluice::validation
