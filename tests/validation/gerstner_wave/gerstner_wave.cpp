#include "validation/gerstner_wave/gerstner_wave.hpp"

#include <cmath>
#include <complex>

#include "validation/support/budget.hpp"
#include "validation/support/files.hpp"
#include "validation/support/scene_run.hpp"

namespace sluice::validation {
namespace {

// Of the scene: gravity [m/s^2], the wave's length and the depth [m], the radius of the circles at the
// surface.
constexpr double kG = 9.81, kLength = 0.503632, kDepth = 0.7 * kLength;
constexpr double kWaveNumber = 2 * M_PI / kLength, kRadius = 0.3 / kWaveNumber;

// That of waves of any height, on deep water; the bottom takes off 0.02 %.
double frequency() {
  return std::sqrt(kG * kWaveNumber * std::tanh(kWaveNumber * kDepth));
}

// The wave's part in the water's height: sum of m y exp(-i k x).
std::complex<double> mode(const SceneRun& run, const fluid::Snapshot& s) {
  std::complex<double> sum = 0;
  for (std::size_t i = 0; i < s.density.size(); ++i)
    sum += run.masses()[i] * s.position[3 * i + 1] * std::polar(1.0, -kWaveNumber * s.position[3 * i]);
  return sum;
}

// How far particles are from where they were, rms [m], the tank being periodic.
double moved(const fluid::Snapshot& before, const fluid::Snapshot& now) {
  double sum = 0;
  for (std::size_t i = 0; i < now.density.size(); ++i) {
    const double dx = std::remainder(now.position[3 * i] - before.position[3 * i], kLength);
    const double dy = now.position[3 * i + 1] - before.position[3 * i + 1];
    sum += dx * dx + dy * dy;
  }
  return std::sqrt(sum / static_cast<double>(now.density.size()));
}

Outcome run(int resolution, const std::vector<std::string>& overrides, int threads) {
  SceneRun run(case_file("gerstner_wave/gerstner_wave.scene"), with_spacing(kLength / resolution, overrides),
               threads);
  const fluid::Snapshot start = run.solver().snapshot();
  const std::complex<double> first = mode(run, start);
  // Of the wave: half of its energy is kinetic.
  const double wave = 2 * run.solver().diagnostics().kinetic;
  std::complex<double> last = first;
  EnergyRise rise(run);
  double phase = 0, time = 0;  // that the wave has gone on by, until then
  while (run.next_output()) {
    const std::complex<double> now = mode(run, run.solver().snapshot());
    phase -= std::arg(now / last);
    time = run.time();
    last = now;
    rise.look(run);
  }
  const double error = moved(start, run.solver().snapshot()) / kRadius;
  return run.outcome(
      {{"off their places after three periods", "% of A, rms", 100 * error, 5},
       {"speed of the wave", "% from theory", 100 * std::abs(phase / time / frequency() - 1), 0.3},
       {"amplitude left after three periods", "%", 100 * std::abs(last / first), 97, true},
       {"energy", "% of the wave's risen at most", 100 * rise.most() / wave, 1}},
      error);
}

}  // namespace

Case gerstner_wave() {
  return {.name = "gerstner_wave",
          .title = "Gerstner's wave, kA = 0.3, three periods, particles over its length",
          .reference = "Gerstner 1802, exact on deep water",
          .resolutions = {30, 60, 120},
          .quick = {30},
          .bound_resolution = 120,
          .run = run};
}

}  // namespace sluice::validation
