#pragma once

#include "validation/support/case.hpp"

namespace sluice::validation {

Case still_drop();
Case oscillating_drop();
Case oscillating_drop_3d();

}  // namespace sluice::validation
