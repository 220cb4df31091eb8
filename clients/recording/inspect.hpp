#pragma once

#include <string>

#include "clients/recording/reader.hpp"

namespace sluice::clients {

// What is in a recording, for people: a table of several lines.
std::string inspect(const Reader& recording);

// The same as one JSON object.
std::string inspect_json(const Reader& recording);

}  // namespace sluice::clients
