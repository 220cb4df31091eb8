#pragma once

#include <string>
#include <vector>

#include "benchmark/measurement.hpp"

namespace sluice::benchmark {

// The table of one case, for reading.
std::string to_text(const CaseTable& table);

// The tables of all cases, one line a figure, with a line of column names.
std::string to_csv(const std::vector<CaseTable>& tables);

}  // namespace sluice::benchmark
