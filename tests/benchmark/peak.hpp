#pragma once

namespace sluice::benchmark {

// Floating-point operations in double precision that one core does a second, by multiply-adds in registers
// with the widest vectors it has: what shares of the peak are of. Takes a tenth of a second.
double measure_peak();

}  // namespace sluice::benchmark
