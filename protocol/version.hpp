#pragma once

#include <cstdint>

namespace sluice::protocol {

// Raised by any change of messages.proto that an older peer would misread.
inline constexpr std::uint32_t kProtocolVersion = 1;

}  // namespace sluice::protocol
