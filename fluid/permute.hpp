#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

namespace sluice::fluid {

// Entry k becomes what was entry order[k]; an array that is not used stays empty.
template <typename T>
void permute(std::vector<T>& values, const std::vector<std::uint32_t>& order) {
  if (values.empty()) return;
  std::vector<T> sorted;
  sorted.reserve(std::max(values.capacity(), order.size()));  // images may follow again
  for (const std::uint32_t k : order) sorted.push_back(values[k]);
  values.swap(sorted);
}

}  // namespace sluice::fluid
