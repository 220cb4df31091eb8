#pragma once

#include "benchmark/checks.hpp"

namespace sluice::benchmark {

// Runs the checks, prints their tables, writes the files. Returns the exit code: 1 when a bound is missed.
// Throws InputError for a check that does not exist or a file that cannot be written.
int stability(const StabilityOptions& options);

}  // namespace sluice::benchmark
