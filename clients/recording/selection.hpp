#pragma once

#include <string>

#include "clients/recording/reader.hpp"

namespace sluice::clients {

// What the scene's output selects of the particles, for people; empty where that is everything.
std::string selection_text(const Reader& recording);

}  // namespace sluice::clients
