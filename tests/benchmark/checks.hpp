#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "benchmark/stability_table.hpp"

namespace sluice::benchmark {

struct StabilityOptions {
  std::vector<std::string> checks;  // empty: all
  bool quick = false;               // seconds instead of an hour
  std::uint64_t scenes = 500, first_seed = 1;
  std::string write;  // directory for the random scenes; empty: none
  std::string csv;    // file; empty: none
};

// One check of the stability benchmark.
struct StabilityCheck {
  std::string name;
  std::function<StabilityTable(const StabilityOptions&)> run;
};

// In the order of the tables.
const std::vector<StabilityCheck>& all_checks();

// Random violent scenes at the defaults; a row a scene that fails.
StabilityTable random_scenes(const StabilityOptions& options);
// Impacts and splashes in the plane and in space, over the floor of the moments' eigenvalues.
StabilityTable violent(const StabilityOptions& options);
// Growth of a velocity that alternates from particle to particle, on a lattice under uniform pressure.
StabilityTable checkerboard(const StabilityOptions& options);
// Growth of waves of displacement of that lattice, over the smoothing length.
StabilityTable lattice_waves(const StabilityOptions& options);
// How far kernels are from the criteria PC (20)-(25).
StabilityTable kernel_sums(const StabilityOptions& options);
// Largest Courant number at which a few scenes stay sound.
StabilityTable largest_courant(const StabilityOptions& options);
// A tank at rest for long.
StabilityTable still_tank(const StabilityOptions& options);

}  // namespace sluice::benchmark
