#include "validation/channel_start_up/channel_start_up.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "validation/support/files.hpp"
#include "validation/support/scene_run.hpp"

namespace sluice::validation {
namespace {

// Of the scenes, in units of the channel's height [m] and the largest speed [m/s].
constexpr double kViscosity = 0.1;  // nu [m^2/s]
constexpr double kForce = 8 * kViscosity;
constexpr int kSpacingsAlong = 12;
constexpr int kTerms = 200;        // of the series; the last is below 1e-16 from the first output on
constexpr double kEarly = 0.0999;  // t nu/H^2 from which on the profile is that of a channel, not of one wall

using Profile = double (*)(double y, double t);

double poiseuille(double y, double t) {
  double u = 0.5 * kForce / kViscosity * y * (1 - y);
  for (int n = 0; n < kTerms; ++n) {
    const double k = (2 * n + 1) * M_PI;
    u -= 4 * kForce / (kViscosity * k * k * k) * std::sin(k * y) * std::exp(-k * k * kViscosity * t);
  }
  return u;
}

double couette(double y, double t) {
  double u = y;
  for (int n = 1; n <= kTerms; ++n) {
    const double k = n * M_PI;
    u += 2 / k * (n % 2 == 0 ? 1 : -1) * std::sin(k * y) * std::exp(-k * k * kViscosity * t);
  }
  return u;
}

// Velocity of the particles less the exact one at their place and time, over the exact one; both rms.
double profile_error(const SceneRun& run, Profile exact) {
  const fluid::Snapshot s = run.solver().snapshot();
  double difference = 0, reference = 0;
  for (std::size_t i = 0; i < s.density.size(); ++i) {
    const double u = exact(s.position[3 * i + 1], run.time());
    difference += std::pow(s.velocity[3 * i] - u, 2) + std::pow(s.velocity[3 * i + 1], 2);
    reference += u * u;
  }
  return std::sqrt(difference / reference);
}

// A flow by the name of its scene.
struct Flow {
  std::string name, title;
  Profile exact;
};

Outcome run(const Flow& flow, int resolution, const std::vector<std::string>& overrides, int threads) {
  const std::string corner = fmt::format("=[{}, 1]", static_cast<double>(kSpacingsAlong) / resolution);
  auto all = with_spacing(1.0 / resolution, {"domain.max" + corner, "fluid[0].box.max" + corner});
  all.insert(all.end(), overrides.begin(), overrides.end());
  SceneRun run(case_file("channel_start_up/" + flow.name + ".scene"), all, threads);
  double largest = 0;
  while (run.next_output())
    if (run.time() * kViscosity > kEarly) largest = std::max(largest, profile_error(run, flow.exact));
  const double error = profile_error(run, flow.exact);
  return run.outcome({{"profile at t nu/H^2 = 0.5", "% rms of the exact one", 100 * error, 0.5},
                      {"profile from t nu/H^2 = 0.1 on", "% rms of the exact one", 100 * largest}},
                     error);
}

Case start_up(const Flow& flow) {
  return {.name = flow.name + "_start_up",
          .title = flow.title + " start-up, Re 10, t nu/H^2 = 0.5, particles between the walls",
          .reference = "Morris, Fox & Zhu 1997",
          .resolutions = {12, 25, 50},
          .quick = {12},
          .bound_resolution = 50,
          .run = [flow](int resolution, const std::vector<std::string>& overrides, int threads) {
            return run(flow, resolution, overrides, threads);
          }};
}

}  // namespace

Case poiseuille_start_up() {
  return start_up({"poiseuille", "Poiseuille", poiseuille});
}
Case couette_start_up() {
  return start_up({"couette", "Couette", couette});
}

}  // namespace sluice::validation
