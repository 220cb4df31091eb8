#include "clients/sluice/check.hpp"

#include <fmt/core.h>
#include <spdlog/spdlog.h>

#include <iostream>

#include "clients/recording/size.hpp"
#include "clients/sluice/progress.hpp"

namespace sluice::clients {

namespace {

std::string with_recording(const Estimate& estimate, const Scene& scene) {
  const std::uint64_t recorded = most_recorded(scene, estimate.fluid_particles);
  const std::uint64_t bytes = recording_bytes({.scene = scene,
                                               .fluid_particles = recorded,
                                               .boundary_particles = estimate.boundary_particles,
                                               .frames = estimate.frames,
                                               .steps = estimate.steps});
  const std::string of = recorded == estimate.fluid_particles
                             ? ""
                             : fmt::format(" of up to {} particles in its region", recorded);
  return fmt::format("{}; a recording has {} frames{} and {:.0f} MB", to_string(estimate), estimate.frames,
                     of, 1e-6 * static_cast<double>(bytes));
}

}  // namespace

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
  const Scene scene = protocol::SceneFile::load(options.scene, options.overrides).scene();
  std::cout << fmt::format("{}: no errors; {}\n", options.scene.string(), with_recording(estimate, scene))
            << std::flush;
  return protocol::kDone;
}

}  // namespace sluice::clients
