#pragma once

#include <string>

namespace sluice::benchmark {

// Draws error over run time from the text of to_csv: log-log, a panel a case, a line a formulation. Throws
// std::runtime_error when the script fails.
void plot(const std::string& csv, const std::string& picture);

}  // namespace sluice::benchmark
