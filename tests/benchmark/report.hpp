#pragma once

#include <fstream>
#include <string>
#include <vector>

#include "benchmark/measurement.hpp"

namespace sluice::benchmark {

// Throws InputError when it cannot be written.
std::ofstream open_output(const std::string& path);

// Text as a field of a CSV file.
std::string csv_field(std::string text);

// The table of one case, for reading.
std::string to_text(const CaseTable& table);

// The tables of all cases, one line a figure, with a line of column names.
std::string to_csv(const std::vector<CaseTable>& tables);

}  // namespace sluice::benchmark
