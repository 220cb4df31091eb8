#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "validation/support/files.hpp"
#include "validation/support/results.hpp"
#include "validation/support/scene_run.hpp"

namespace sluice::validation {
namespace {

constexpr double kG = 9.81;        // [m/s^2]
constexpr double kDepth = 0.25;    // [m], of still_tank.scene
constexpr double kSpacing = 0.01;  // [m]

// Root mean square of p - rho0 g (H - y) over the particles, as a share of rho0 g H.
double pressure_error(const fluid::Snapshot& s) {
  double sum = 0;
  for (std::size_t i = 0; i < s.pressure.size(); ++i) {
    const double exact = 1000.0 * kG * (kDepth - s.position[3 * i + 1]);
    sum += (s.pressure[i] - exact) * (s.pressure[i] - exact);
  }
  return std::sqrt(sum / static_cast<double>(s.pressure.size())) / (1000.0 * kG * kDepth);
}

// Height of the highest and of the lowest particle of the first layer, over where it started [spacings].
std::pair<double, double> surface_drift(const fluid::Snapshot& start, const fluid::Snapshot& now) {
  double highest = -1e9, lowest = 1e9;
  for (std::size_t i = 0; i < start.density.size(); ++i) {
    if (start.position[3 * i + 1] < kDepth - kSpacing) continue;
    const double rise = (now.position[3 * i + 1] - start.position[3 * i + 1]) / kSpacing;
    highest = std::max(highest, rise);
    lowest = std::min(lowest, rise);
  }
  return {lowest, highest};
}

// Hydrostatic column, p = rho0 g (H - y), no motion: 25 particles of depth to t sqrt(g/H) = 20.
TEST(StillTank, StaysAtRestWithHydrostaticPressure) {
  SceneRun run(shipped_scene("still_tank"));
  ASSERT_GE(run.end_time() * std::sqrt(kG / kDepth), 20.0 - 1e-3);
  const fluid::Snapshot start = run.solver().snapshot();
  const double potential = run.solver().diagnostics().potential;
  std::ofstream csv(result_file("still_tank.csv"));
  csv << "time_s,kinetic_over_potential,pressure_error,surface_low_dx,surface_high_dx\n";
  while (run.next_output()) {
    const fluid::Diagnostics d = run.solver().diagnostics();
    const fluid::Snapshot now = run.solver().snapshot();
    const auto [low, high] = surface_drift(start, now);
    csv << run.time() << ',' << d.kinetic / potential << ',' << pressure_error(now) << ',' << low << ','
        << high << '\n';
    EXPECT_LE(d.kinetic / potential, 1e-8) << "at " << run.time() << " s";
    EXPECT_LE(pressure_error(now), 0.004) << "at " << run.time() << " s";
    EXPECT_LE(std::max(-low, high), 0.05) << "surface drift in spacings at " << run.time() << " s";
  }
  RecordProperty("kinetic_over_potential", std::to_string(run.solver().diagnostics().kinetic / potential));
  std::printf("still tank: kinetic/potential %.2e, pressure error %.2f %%\n",
              run.solver().diagnostics().kinetic / potential, 100 * pressure_error(run.solver().snapshot()));
}

}  // namespace
}  // namespace sluice::validation
