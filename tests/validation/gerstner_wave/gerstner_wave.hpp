#pragma once

#include "validation/support/case.hpp"

namespace sluice::validation {

// A resolution counts particles over the wave's length, and is a multiple of ten.
Case gerstner_wave();

}  // namespace sluice::validation
