#pragma once

#include <array>

namespace sluice::rigid {

// Value and first two derivatives of the polynomial through seven equidistant values.
struct Derivatives {
  double value, first, second;
};

constexpr int kStencil = 7;

// `samples[k]` stands at center + (k - 3) step; the derivatives are taken at center + shift step, |shift|
// <= 3. B. Fornberg, "Generation of finite difference formulas on arbitrarily spaced grids", Math. Comp. 51
// (1988) 699.
Derivatives differentiate(const std::array<double, kStencil>& samples, double shift, double step);

}  // namespace sluice::rigid
