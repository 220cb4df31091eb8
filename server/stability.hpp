#pragma once

#include <vector>

#include "fluid/setup.hpp"
#include "messages.pb.h"

namespace sluice::server {

// How a run exchanges with its bodies, and why.
struct CouplingPlan {
  sluice::Coupling coupling;             // EXPLICIT or IMPLICIT
  std::vector<BodyStability> stability;  // per body
};

// The largest impedance * time / mass at which the explicit scheme is stable with so many fluid steps an
// exchange, measured (README.md, "Light bodies").
double allowed_indicator(std::uint64_t steps_per_exchange);

// The largest fluid step [s] at which all free bodies are stable by the explicit scheme, infinite where the
// steps are not to be shortened for them, or an exchange is one step: the solver's own limit is that.
double largest_exchange_step(const Scene& scene, const fluid::Setup& setup);

// From a scene with its defaults and fluid steps of `step` [s]. AUTO becomes one of the others.
CouplingPlan plan_coupling(const Scene& scene, const fluid::Setup& setup, double step);

// One line for every free body beyond what the explicit scheme allows, where that is in use: where the plan
// says so, and of bodies with an owner.
std::vector<std::string> stability_warnings(const Scene& scene, const CouplingPlan& plan);

}  // namespace sluice::server
