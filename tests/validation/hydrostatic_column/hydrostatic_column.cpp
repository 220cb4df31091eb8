#include "validation/hydrostatic_column/hydrostatic_column.hpp"

#include <algorithm>
#include <cmath>

#include "fluid/equation_of_state.hpp"
#include "validation/support/files.hpp"
#include "validation/support/scene_run.hpp"

namespace sluice::validation {
namespace {

// Of the scene.
constexpr double kG = 9.81, kDepth = 1;  // [m/s^2], [m]

// Root mean square over the particles of p less its reference at their height, over rho0 g H.
template <typename Reference>
double pressure_error(const fluid::Snapshot& s, double rest_density, const Reference& reference) {
  double sum = 0;
  for (std::size_t i = 0; i < s.pressure.size(); ++i) {
    const double difference = s.pressure[i] - reference(s.position[3 * i + 1]);
    sum += difference * difference;
  }
  return std::sqrt(sum / static_cast<double>(s.pressure.size())) / (rest_density * kG * kDepth);
}

Outcome run(int resolution, const std::vector<std::string>& overrides, int threads) {
  SceneRun run(case_file("hydrostatic_column/hydrostatic_column.scene"),
               with_spacing(kDepth / resolution, overrides), threads);
  double residual = 0;
  while (run.next_output()) {
    const fluid::Diagnostics d = run.solver().diagnostics();
    if (run.time() > 0.8 * run.end_time()) residual = std::max(residual, d.kinetic / d.potential);
  }
  const fluid::Snapshot end = run.solver().snapshot();
  const double rho0 = run.scene().liquid().density();
  const fluid::EquationOfState eos(rho0, run.scene().liquid().sound_speed());
  const double error = pressure_error(end, rho0, [&](double y) { return rho0 * kG * (kDepth - y); });
  const double of_compressed = pressure_error(
      end, rho0, [&](double y) { return eos.pressure(eos.hydrostatic_density(kG * (kDepth - y))); });
  return run.outcome({{"pressure", "% of rho g H, rms", 100 * error, 0.3},
                      {"pressure of the compressed column", "% of rho g H, rms", 100 * of_compressed},
                      {"kinetic/potential", "", residual, 1e-7}},
                     of_compressed);
}

}  // namespace

Case hydrostatic_column() {
  return {.name = "hydrostatic_column",
          .title = "Hydrostatic column, t sqrt(g/H) = 50, particles over H",
          .reference = "p = rho g (H - y)",
          .resolutions = {12, 25, 50},
          .quick = {10},
          .bound_resolution = 50,
          .least_order = 1.8,
          .run = run};
}

}  // namespace sluice::validation
