#include "server/stability.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "fluid/body_step.hpp"
#include "protocol/body_kind.hpp"
#include "server/stability_watch.hpp"

namespace sluice::server {

double allowed_indicator(std::uint64_t steps_per_exchange) {
  (void)steps_per_exchange;
  return 0.5;
}

double largest_exchange_step(const Scene& scene, const fluid::Setup& setup) {
  double largest = std::numeric_limits<double>::infinity();
  const std::uint64_t steps = scene.coupling().steps_per_exchange();
  if (!scene.coupling().shorten_steps() || steps == 1) return largest;
  const double allowed = allowed_indicator(steps) / static_cast<double>(steps);
  for (std::size_t b = 0; b < setup.bodies.size(); ++b) {
    const double mass = setup.bodies[b].free_mass;
    if (mass > 0) largest = std::min(largest, allowed * mass / fluid::body_impedance(setup, b));
  }
  return largest;
}

CouplingPlan plan_coupling(const Scene& scene, const fluid::Setup& setup, double step) {
  CouplingPlan plan{scene.coupling(), {}};
  const std::uint64_t steps = scene.coupling().steps_per_exchange();
  for (std::size_t b = 0; b < setup.bodies.size(); ++b) {
    BodyStability& body = plan.stability.emplace_back();
    const double mass = setup.bodies[b].free_mass;
    body.set_impedance(fluid::body_impedance(setup, b));
    const double time = static_cast<double>(steps) * step;
    const std::optional<WetSurface> surface = wet_surface(scene, b, setup.bodies[b]);
    body.set_indicator(surface ? time * std::max(body.impedance() / mass, surface->whole_rate()) : 0);
    body.set_allowed(allowed_indicator(steps));
  }
  if (plan.coupling.scheme() != AUTO) return plan;
  // Who else moves a body does not repeat exchanges.
  bool all_stable = true;
  for (const int b : protocol::bodies_of(scene, "")) {
    const BodyStability& body = plan.stability[static_cast<std::size_t>(b)];
    all_stable = all_stable && body.indicator() <= body.allowed();
  }
  plan.coupling.set_scheme(all_stable ? EXPLICIT : IMPLICIT);
  // Relaxation by one number finds many steps at once of a light body only badly.
  if (!all_stable) plan.coupling.set_steps_per_exchange(1);
  return plan;
}

std::vector<std::string> stability_warnings(const Scene& scene, const CouplingPlan& plan) {
  std::vector<std::string> lines;
  for (int b = 0; b < scene.body_size(); ++b) {
    const bool is_explicit = plan.coupling.scheme() == EXPLICIT || !scene.body(b).owner().empty();
    const BodyStability& body = plan.stability[static_cast<std::size_t>(b)];
    if (!is_explicit || body.indicator() <= body.allowed()) continue;
    lines.push_back(fmt::format(
        "body '{}': 2 rho c A t/m is {:.3g}, up to {:.3g} is stable with {} steps an exchange; take fewer, "
        "or "
        "{}",
        scene.body(b).name(), body.indicator(), body.allowed(), plan.coupling.steps_per_exchange(),
        scene.body(b).owner().empty() ? "coupling { scheme: AUTO }"
                                      : "leave its owner out: `sluice rigid` can repeat exchanges"));
  }
  return lines;
}

}  // namespace sluice::server
