#pragma once

#include <string>

namespace sluice::protocol {

// The linker's build id of the running program, in hexadecimal: equal for equal code, whatever its path.
// Empty when the linker gave none.
std::string build_id();

}  // namespace sluice::protocol
