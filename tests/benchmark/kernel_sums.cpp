#include "benchmark/kernel_sums.hpp"

#include <fmt/format.h>

#include "benchmark/checks.hpp"
#include "fluid/kernel.hpp"
#include "fluid/setup.hpp"

namespace sluice::benchmark {

namespace {

template <template <int> typename Kernel>
void add(StabilityTable& table, const std::string& name, double smoothing) {
  const KernelSums sums = kernel_sums_of(Kernel<2>(smoothing));
  table.rows.push_back({fmt::format("{}, h/dx = {:g}", name, smoothing),
                        {sums.line_M, sums.line_N, sums.plane_M, sums.plane_N, sums.slope_at_zero},
                        ""});
}

}  // namespace

StabilityTable kernel_sums(const StabilityOptions&) {
  StabilityTable table{
      .name = "kernel_sums",
      .title = "Distance of kernels from the criteria PC (20)-(25), all of which are zero in theory",
      .items = "kernel",
      .columns = {{"line |M-1|", ""},
                  {"line |N|", "1/dx"},
                  {"plane |M-1|", ""},
                  {"plane |N|", "1/dx"},
                  {"W'(0)", "W(0)/dx"}},
      .rows = {},
      .figures = {}};
  for (const double smoothing : {1.0, 1.25, fluid::stable_smoothing(2), 1.75, 2.0}) {
    add<fluid::WendlandC2>(table, "Wendland C2", smoothing);
    add<fluid::CubicSpline>(table, "cubic spline", smoothing);
    add<fluid::TensorSpline>(table, "tensor spline", smoothing);
    add<fluid::SincSquared>(table, "sinc squared", smoothing);
  }
  return table;
}

}  // namespace sluice::benchmark
