#include "validation/interfacial_wave/interfacial_wave.hpp"

#include <fmt/format.h>

#include <cmath>

#include "validation/support/files.hpp"
#include "validation/support/oscillation.hpp"
#include "validation/support/scene_run.hpp"

namespace sluice::validation {
namespace {

// Of the scene.
constexpr double kG = 9.81, kHeavy = 1000;               // [m/s^2], [kg/m^3]
constexpr double kDepth = 0.3, kAbove = 0.7;             // of the layers [m]
constexpr double kWaveNumber = M_PI, kAmplitude = 0.02;  // [1/m], [m]
constexpr double kKappa = kHeavy * 1962 / 7;             // [Pa], c0^2 = 1962 m^2/s^2
constexpr double kPeriods = 2;

// Square of the internal mode's frequency, the smaller root of
//   w^4 (C1 C2 + r) - w^2 g k (C1 + C2) + g^2 k^2 (1 - r) = 0
// with C = coth of k times a depth and r = light over heavy: H. Lamb, Hydrodynamics, art. 231. With a lid
// instead of the free surface it would be g k (1 - r)/(C1 + r C2).
double frequency2(double r) {
  const double c1 = 1 / std::tanh(kWaveNumber * kDepth), c2 = 1 / std::tanh(kWaveNumber * kAbove);
  const double gk = kG * kWaveNumber, a = c1 * c2 + r, b = gk * (c1 + c2), c = gk * gk * (1 - r);
  return 2 * c / (b + std::sqrt(b * b - 4 * a * c));
}

// Height over the interface of a layer and its elevation eta(z) in units of the interface's:
// cosh kz + beta sinh kz.
struct Layer {
  double beta;
  [[nodiscard]] std::string eta() const { return combination("cosh", "sinh"); }
  [[nodiscard]] std::string slope() const { return combination("sinh", "cosh"); }  // over k

 private:
  [[nodiscard]] std::string combination(const char* even, const char* odd) const {
    const std::string kz = fmt::format("({:.17g}*(y - {}))", kWaveNumber, kDepth);
    return fmt::format("({}{} + ({:.17g})*{}{})", even, kz, beta, odd, kz);
  }
};

Layer lower() {
  return {1 / std::tanh(kWaveNumber * kDepth)};
}

// At the surface eta' = g k^2/w^2 eta, so that the pressure stays zero there.
Layer upper(double w2) {
  const double c = std::cosh(kWaveNumber * kAbove), s = std::sinh(kWaveNumber * kAbove);
  const double ratio = kG * kWaveNumber / w2;
  return {(ratio * c - s) / (c - ratio * s)};
}

// kappa ((1 + on_top/kappa)^(6/7) + 6 rho g (top - y)/(7 kappa))^(7/6) - kappa, EquationOfState.
std::string hydrostatic(double rho, double top, double on_top) {
  return fmt::format("{:.17g}*(({:.17g} + {:.17g}*({} - y))^(7/6) - 1)", kKappa,
                     std::pow(1 + on_top / kKappa, 6.0 / 7), 6 * rho * kG / (7 * kKappa), top);
}

// Displacement (-A eta'/k sin kx, A eta cos kx), and a particle's pressure besides the hydrostatic one of
// where it came from, rho A (w^2 eta'/k^2 - g eta) cos kx.
std::vector<std::string> start(int region, const Layer& layer, double rho, double w2,
                               const std::string& hydrostatic) {
  const std::string fluid = fmt::format("fluid[{}].", region), k = fmt::format("{:.17g}", kWaveNumber);
  return {fmt::format("{}displacement.x=\"-{}*{}*sin({}*x)\"", fluid, kAmplitude, layer.slope(), k),
          fmt::format("{}displacement.y=\"{}*{}*cos({}*x)\"", fluid, kAmplitude, layer.eta(), k),
          fmt::format("{}pressure=\"{} + {:.17g}*({:.17g}*{} - {}*{})*cos({}*x)\"", fluid, hydrostatic,
                      rho * kAmplitude, w2 / kWaveNumber, layer.slope(), kG, layer.eta(), k)};
}

SceneRun make_run(double ratio, double w2, int resolution, const std::vector<std::string>& overrides,
                  int threads) {
  const double light = kHeavy / ratio;
  std::vector<std::string> all = with_spacing(1.0 / resolution, overrides);
  all.push_back(fmt::format("other_liquid[0].density={:.17g}", light));
  const double at_interface = kKappa * (std::pow(1 + 6 * light * kG * kAbove / (7 * kKappa), 7.0 / 6) - 1);
  for (const std::string& line : start(0, lower(), kHeavy, w2, hydrostatic(kHeavy, kDepth, at_interface)))
    all.push_back(line);
  for (const std::string& line : start(1, upper(w2), light, w2, hydrostatic(light, kDepth + kAbove, 0)))
    all.push_back(line);
  return SceneRun(case_file("interfacial_wave/interfacial_wave.scene"), all, threads);
}

// First spatial mode of the heavy liquid's height: sum of m y cos(kx).
double mode(const SceneRun& run) {
  const fluid::Snapshot s = run.solver().snapshot();
  double sum = 0;
  for (std::size_t i = 0; i < s.density.size(); ++i)
    if (s.liquid[i] == 0)
      sum += run.masses()[i] * s.position[3 * i + 1] * std::cos(kWaveNumber * s.position[3 * i]);
  return sum;
}

Outcome measure(double ratio, int resolution, const std::vector<std::string>& overrides, int threads) {
  const double w2 = frequency2(1 / ratio), frequency = std::sqrt(w2);
  SceneRun run = make_run(ratio, w2, resolution, overrides, threads);
  const double start = mode(run), last = kPeriods * 2 * M_PI / frequency;
  Curve curve{{0.0}, {1.0}};
  while (run.next_output() && run.time() <= last) {
    curve.x.push_back(run.time());
    curve.y.push_back(mode(run) / start);
  }
  const Oscillation found = fit_oscillation(curve, {.frequency = frequency, .cosine = 1});
  const double error = std::abs(frequency / found.frequency - 1);
  const double left = std::exp(-found.decay * last);
  return run.outcome({{"period", "% from linear theory", 100 * error, 1},
                      {"amplitude left after 2 periods", "%", 100 * left}},
                     error);
}

Case wave(int ratio, std::vector<int> resolutions) {
  return {.name = fmt::format("interfacial_wave_{}", ratio),
          .title = fmt::format(
              "Standing wave between liquids of {}:1, two periods, particles over both layers", ratio),
          .reference = "Lamb 1932, art. 231, internal mode of two layers with a free surface",
          .resolutions = std::move(resolutions),
          .quick = {10},
          .bound_resolution = 40,
          .run = [ratio](int resolution, const std::vector<std::string>& overrides, int threads) {
            return measure(ratio, resolution, overrides, threads);
          }};
}

}  // namespace

Case interfacial_wave_2() {
  return wave(2, {10, 20, 40});
}
Case interfacial_wave_10() {
  return wave(10, {10, 20, 40});
}
Case interfacial_wave_1000() {
  return wave(1000, {10, 20, 40});
}

}  // namespace sluice::validation
