#pragma once

#include <filesystem>

namespace sluice::clients {

// Writes RUN.xdmf beside RUN.h5, and RUN.xdmf.h5, which it needs (frame_views.hpp): the fluid's particles
// over time for ParaView and VisIt, with any of their XDMF readers. Throws std::runtime_error when it cannot.
void write_xdmf(const std::filesystem::path& recording);

}  // namespace sluice::clients
