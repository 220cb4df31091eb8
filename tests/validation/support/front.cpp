#include "validation/support/front.hpp"

#include <algorithm>
#include <cstddef>
#include <functional>

namespace sluice::validation {

double front_of(std::vector<double> way, double spacing) {
  constexpr std::size_t kCount = 4;
  std::sort(way.begin(), way.end(), std::greater<>());
  std::size_t k = 0;
  while (k + kCount < way.size() && way[k] - way[k + kCount - 1] > kCount * spacing) ++k;
  return way[k];
}

}  // namespace sluice::validation
