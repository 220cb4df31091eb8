#pragma once

#include "validation/support/case.hpp"

namespace sluice::validation {

Case lock_exchange();

}  // namespace sluice::validation
