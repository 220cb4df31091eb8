#pragma once

#include <string>

namespace sluice::benchmark {

// Draws what the script, one of this folder's, makes of the text of a table. Throws std::runtime_error when
// it fails.
void plot(const std::string& script, const std::string& csv, const std::string& picture);

}  // namespace sluice::benchmark
