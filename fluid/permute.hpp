#pragma once

#include <cstdint>
#include <vector>

namespace sluice::fluid {

// Entry k becomes what was entry order[k]; an array that is not used stays empty.
template <typename T>
void permute(std::vector<T>& values, const std::vector<std::uint32_t>& order) {
  if (values.empty()) return;
  std::vector<T> sorted(order.size());
  for (std::size_t k = 0; k < order.size(); ++k) sorted[k] = values[order[k]];
  values.swap(sorted);
}

}  // namespace sluice::fluid
