#include "validation/support/wetted_area.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "fluid/kernel.hpp"

namespace sluice::validation {

namespace {

struct Raster {
  double cell, left, bottom;
  long columns, rows;
  std::vector<double> sum;

  Raster(std::span<const double> position, double width, double margin) : cell(width) {
    double right = position[0], top = position[1];
    left = right;
    bottom = top;
    for (std::size_t i = 0; i < position.size(); i += 3) {
      left = std::min(left, position[i]);
      right = std::max(right, position[i]);
      bottom = std::min(bottom, position[i + 1]);
      top = std::max(top, position[i + 1]);
    }
    left -= margin;
    bottom -= margin;
    columns = std::lround(std::ceil((right + margin - left) / cell));
    rows = std::lround(std::ceil((top + margin - bottom) / cell));
    sum.assign(static_cast<std::size_t>(columns * rows), 0.0);
  }

  void add(double x, double y, double volume, const fluid::WendlandC2<2>& kernel) {
    const double reach = kernel.support();
    const long first_column = std::lround(std::floor((x - reach - left) / cell));
    const long first_row = std::lround(std::floor((y - reach - bottom) / cell));
    const long count = std::lround(std::ceil(2 * reach / cell)) + 1;
    for (long row = std::max(0L, first_row); row < std::min(rows, first_row + count); ++row) {
      for (long column = std::max(0L, first_column); column < std::min(columns, first_column + count);
           ++column) {
        const double dx = left + (static_cast<double>(column) + 0.5) * cell - x;
        const double dy = bottom + (static_cast<double>(row) + 0.5) * cell - y;
        sum[static_cast<std::size_t>(row * columns + column)] += volume * kernel.value(dx * dx + dy * dy);
      }
    }
  }
};

}  // namespace

double wetted_area(std::span<const double> position, std::span<const double> volume, double spacing) {
  const fluid::WendlandC2<2> kernel(1.5 * spacing);
  Raster raster(position, 0.25 * spacing, kernel.support());
  for (std::size_t i = 0; i < volume.size(); ++i)
    raster.add(position[3 * i], position[3 * i + 1], volume[i], kernel);
  const auto wet = std::count_if(raster.sum.begin(), raster.sum.end(), [](double s) { return s > 0.5; });
  return static_cast<double>(wet) * raster.cell * raster.cell;
}

}  // namespace sluice::validation
