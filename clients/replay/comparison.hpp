#pragma once

#include <optional>
#include <string>

#include "clients/recording/reader.hpp"

namespace sluice::clients {

// Compares two messages of one kind bit by bit: step, time, arrays in their order, energies. The first
// difference in words: which field, of what, both values; nothing when they are identical. `scene` names the
// bodies.
std::optional<std::string> first_difference(const protocol::Message& recorded, const protocol::Message& now,
                                            const Scene& scene);

}  // namespace sluice::clients
