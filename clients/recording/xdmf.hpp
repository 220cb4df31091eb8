#pragma once

#include <filesystem>

namespace sluice::clients {

// Writes RUN.xdmf beside RUN.h5: the fluid's particles over time for ParaView and VisIt (XDMF 2; their XDMF 3
// readers do not take hyperslabs of such files). Throws std::runtime_error when it cannot be written.
void write_xdmf(const std::filesystem::path& recording);

}  // namespace sluice::clients
