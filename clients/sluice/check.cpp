#include "clients/sluice/check.hpp"

#include <fmt/core.h>
#include <spdlog/spdlog.h>

#include <iostream>

#include "clients/sluice/progress.hpp"

namespace sluice::clients {

Estimate require_sound(const CheckOptions& options) {
  const auto file = protocol::SceneFile::load(options.scene, options.overrides);
  const Preflight found = preflight(file);
  for (const auto& warning : found.warnings) spdlog::warn("warning: {}", protocol::to_string(warning));
  if (!found.errors.empty()) throw protocol::SceneError(found.errors);
  return found.estimate;
}

std::string to_string(const Estimate& estimate) {
  return fmt::format("{} fluid and {} boundary particles, {} steps, {:.0f} MB, about {} on one thread",
                     estimate.fluid_particles, estimate.boundary_particles, estimate.steps,
                     1e-6 * static_cast<double>(estimate.memory_bytes), clock_text(estimate.run_seconds));
}

int check(const CheckOptions& options) {
  const Estimate estimate = require_sound(options);
  std::cout << fmt::format("{}: no errors; {}\n", options.scene.string(), to_string(estimate)) << std::flush;
  return protocol::kDone;
}

}  // namespace sluice::clients
