#pragma once

#include "validation/support/case.hpp"

namespace sluice::validation {

Case taylor_green();

}  // namespace sluice::validation
