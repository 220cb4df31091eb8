#pragma once

#include "validation/support/case.hpp"

namespace sluice::validation {

Case poiseuille_start_up();
Case couette_start_up();

}  // namespace sluice::validation
