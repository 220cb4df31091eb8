#include "rigid/difference.hpp"

namespace sluice::rigid {
namespace {

// weight[d][k]: of sample k in derivative d, for nodes at -3 .. 3 and unit step (Fornberg's recursion).
using Weights = std::array<std::array<double, kStencil>, 3>;

Weights weights_at(double x) {
  Weights w{};
  const auto node = [](int k) { return static_cast<double>(k - kStencil / 2); };
  w[0][0] = 1;
  double c1 = 1, c4 = node(0) - x;
  for (int i = 1; i < kStencil; ++i) {
    double c2 = 1;
    const double c5 = c4;
    c4 = node(i) - x;
    for (int j = 0; j < i; ++j) {
      const double c3 = node(i) - node(j);
      c2 *= c3;
      if (j == i - 1) {
        for (int d = 2; d > 0; --d) w[d][i] = c1 * (d * w[d - 1][i - 1] - c5 * w[d][i - 1]) / c2;
        w[0][i] = -c1 * c5 * w[0][i - 1] / c2;
      }
      for (int d = 2; d > 0; --d) w[d][j] = (c4 * w[d][j] - d * w[d - 1][j]) / c3;
      w[0][j] = c4 * w[0][j] / c3;
    }
    c1 = c2;
  }
  return w;
}

}  // namespace

Derivatives differentiate(const std::array<double, kStencil>& samples, double shift, double step) {
  const Weights w = weights_at(shift);
  std::array<double, 3> sum{};
  for (int d = 0; d < 3; ++d)
    for (int k = 0; k < kStencil; ++k) sum[d] += w[d][k] * samples[k];
  return {sum[0], sum[1] / step, sum[2] / (step * step)};
}

}  // namespace sluice::rigid
