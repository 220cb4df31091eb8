#pragma once

#include <cstdint>

#include "clients/recording/reader.hpp"
#include "clients/recording/writer.hpp"

namespace sluice::clients {

// How far a recording goes.
struct Extent {
  std::uint64_t frames = 0, exchanges = 0;
  [[nodiscard]] bool operator==(const Extent&) const = default;
};

// Writes the first frames and exchanges of one recording into another, in the order of the run, and flushes.
// Ends before the first that is not what was written, and returns how far it came. Precondition: there are as
// many.
Extent copy_rows(const Reader& from, Writer& to, const Extent& extent);

}  // namespace sluice::clients
