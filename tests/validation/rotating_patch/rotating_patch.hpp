#pragma once

#include "validation/support/case.hpp"

namespace sluice::validation {

Case rotating_patch();

}  // namespace sluice::validation
