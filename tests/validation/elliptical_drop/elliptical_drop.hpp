#pragma once

#include "validation/support/case.hpp"

namespace sluice::validation {

Case elliptical_drop();

}  // namespace sluice::validation
