#pragma once

#include <bit>
#include <cstdint>
#include <limits>
#include <optional>

#include "messages.pb.h"

namespace sluice::protocol {

static_assert(std::endian::native == std::endian::little, "raw frames are little-endian");

// Bytes of one element; 0 for a type this version does not know.
constexpr std::uint64_t element_size(Array::Type type) {
  switch (type) {
    case Array::FLOAT32:
    case Array::INT32:
      return 4;
    case Array::FLOAT64:
    case Array::INT64:
    case Array::UINT64:
      return 8;
    default:
      return 0;
  }
}

// The product of the extents (1 for no extents), or nothing where elements of 8 bytes would not fit into 63
// bits.
template <typename Extents>
std::optional<std::uint64_t> element_count(const Extents& extents) {
  constexpr std::uint64_t kMost = std::numeric_limits<std::int64_t>::max() / 8;
  std::uint64_t count = 1;
  bool empty = false;
  for (const std::uint64_t extent : extents) {
    empty = empty || extent == 0;
    if (extent > kMost || (extent > 0 && count > kMost / extent)) return std::nullopt;
    if (extent > 0) count *= extent;
  }
  return empty ? 0 : count;
}

}  // namespace sluice::protocol
