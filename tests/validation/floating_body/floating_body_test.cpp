#include "validation/floating_body/floating_body.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <fstream>
#include <numbers>
#include <numeric>

#include "validation/floating_body/linear_heave.hpp"
#include "validation/support/files.hpp"
#include "validation/support/results.hpp"
#include "validation/support/scene_run.hpp"

namespace sluice::validation {
namespace {

struct Afloat {
  const char* scene;
  double density;
};

void PrintTo(const Afloat& afloat, std::ostream* out) {
  *out << afloat.scene << " " << afloat.density;
}

class Floating : public testing::TestWithParam<Afloat> {};

// A body at its level stays there: the force of the first fifty steps carries its weight, and its draft is
// that of Archimedes within 1 % of its height.
TEST_P(Floating, StartsAtRestAndStaysAtItsLevel) {
  const FloatResult result =
      float_body({.scene = GetParam().scene, .density = GetParam().density, .duration = 1, .overrides = {}});
  double jump = 0, worst = 0;
  for (std::size_t k = 0; k < 50; ++k)
    jump = std::max(jump, std::abs(result.force.y.at(k) / result.weight - 1));
  for (const double draft : result.draft.y) worst = std::max(worst, std::abs(draft - result.level) / 0.4);
  std::printf(
      "%s of %g kg/m^3: force of the first 50 steps within %.2f %% of the weight, draft within %.2f %% of "
      "the height, %.2f iterations\n",
      GetParam().scene, GetParam().density, 100 * jump, 100 * worst, result.iterations);
  EXPECT_LT(worst, 0.01);
}

INSTANTIATE_TEST_SUITE_P(Densities, Floating,
                         testing::Values(Afloat{"floating_box", 50}, Afloat{"floating_box", 300},
                                         Afloat{"floating_box", 900}, Afloat{"floating_cylinder", 50},
                                         Afloat{"floating_cylinder", 300}, Afloat{"floating_cylinder", 900}));

// When a curve first crosses `level` downwards and next upwards.
std::pair<double, double> crossings(const Curve& curve, double level) {
  double down = 0;
  for (std::size_t k = 1; k < curve.x.size(); ++k) {
    const double a = curve.y[k - 1] - level, b = curve.y[k] - level;
    if (a * b > 0 || a == b) continue;
    const double t = curve.x[k - 1] + (curve.x[k] - curve.x[k - 1]) * a / (a - b);
    if (down == 0)
      down = t;
    else
      return {down, t};
  }
  throw std::runtime_error("the curve does not cross the level twice");
}

// Half the natural period is the time between two passages of the level of rest; in the closed tank that is
// 3/8 of the lift, since the box leaves as much room below it as spreads over the whole surface.
TEST(Heave, PeriodIsThatOfLinearTheoryInTheSameTank) {
  const double lift = 0.02, rest = 0.8 - archimedes_draft("floating_box", 300) + 0.2;
  FloatResult result =
      float_body({.scene = "floating_box", .density = 300, .lift = lift, .duration = 1.2, .overrides = {}});
  for (double& y : result.height.y) y -= rest;
  const Curve theory = linear_heave({.lift = lift}, 0.01, 1.25);
  const double level = lift * 0.6 / 1.6;
  const auto [down, up] = crossings(result.height, level);
  const auto [theory_down, theory_up] = crossings(theory, level);
  std::ofstream file(result_file("heave.csv"));
  file << "# t [s], height above the level of rest [m]: computed, linear theory\n";
  for (std::size_t k = 0; k < result.height.x.size(); ++k)
    file << result.height.x[k] << ',' << result.height.y[k] << ',' << theory.at(result.height.x[k]) << '\n';
  std::printf("heave: half a period %.4f s, linear theory %.4f s (%+.2f %%)\n", up - down,
              theory_up - theory_down, 100 * ((up - down) / (theory_up - theory_down) - 1));
  EXPECT_NEAR(up - down, theory_up - theory_down, 0.02 * (theory_up - theory_down));
  EXPECT_LE(*std::max_element(result.height.y.begin(), result.height.y.end()), 1.01 * lift);
}

Curve force_on(const std::vector<std::string>& overrides) {
  SceneRun run(case_file("floating_body/held_box.scene"), overrides);
  Curve force;
  while (run.next_step()) {
    force.x.push_back(run.time());
    force.y.push_back(run.wrench(0).force.y());
  }
  return force;
}

TEST(Force, IsQuietOnAHeldBody) {
  const Curve force = force_on({});
  const auto n = static_cast<double>(force.y.size());
  const double mean = std::accumulate(force.y.begin(), force.y.end(), 0.0) / n;
  double variance = 0;
  for (const double f : force.y) variance += (f - mean) * (f - mean) / n;
  const double buoyancy = 1000 * 9.81 * 0.6 * 0.2;
  std::printf("held box: mean force %+.2f %% of the buoyancy's, standard deviation %.3f %% of the mean\n",
              100 * (mean / buoyancy - 1), 100 * std::sqrt(variance) / mean);
  EXPECT_LT(std::sqrt(variance), 0.005 * mean);
  EXPECT_NEAR(mean, buoyancy, 0.01 * buoyancy);
}

// Heaved by 10 mm at 2 Hz, with the waves of the tank: amplitudes of the force over frequency, and the share
// of its variance above 20 Hz, which no wave has.
TEST(Force, SpectrumInForcedOscillation) {
  const Curve all =
      force_on({R"~(body[0].prescribed={expression {y: "0.01*(1-cos(4*pi*t))"}})~", "duration=1.5"});
  Curve force;  // of whole periods
  for (std::size_t k = 0; k < all.x.size(); ++k) {
    if (all.x[k] <= 0.5) continue;
    force.x.push_back(all.x[k]);
    force.y.push_back(all.y[k]);
  }
  const auto n = static_cast<double>(force.y.size());
  const double mean = std::accumulate(force.y.begin(), force.y.end(), 0.0) / n;
  std::ofstream file(result_file("force_spectrum.csv"));
  file << "# frequency [Hz], amplitude of the force on a box heaved by 10 mm at 2 Hz [N/m]\n";
  double variance = 0, noise = 0;
  for (int k = 1; k <= 200; ++k) {
    std::complex<double> sum = 0;
    for (std::size_t i = 0; i < force.y.size(); ++i)
      sum += (force.y[i] - mean) * std::polar(1.0, -2 * std::numbers::pi * k * force.x[i]);
    const double amplitude = 2 * std::abs(sum) / n;
    file << k << ',' << amplitude << '\n';
    variance += 0.5 * amplitude * amplitude;
    if (k > 20) noise += 0.5 * amplitude * amplitude;
  }
  std::printf("heaved box: %.1f %% of the force's variance is above 20 Hz, %.2f %% of the mean force\n",
              100 * noise / variance, 100 * std::sqrt(noise) / mean);
  EXPECT_LT(noise, 0.1 * variance);
}

}  // namespace
}  // namespace sluice::validation
