#include "server/stability_watch.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>

#include "protocol/body_kind.hpp"
#include "protocol/liquids.hpp"
#include "server/stability.hpp"
#include "server/stop.hpp"

namespace sluice::server {

namespace {

constexpr std::uint64_t kLookEvery = 8;  // [steps]

// 1 along the axes that are ever free.
Eigen::Vector3d free_of(const Body& body, const google::protobuf::RepeatedField<int>& locked,
                        const google::protobuf::RepeatedField<int>& free) {
  const bool is_guided = protocol::is_partly_free(body) && !body.prescribed().has_release();
  Eigen::Vector3d axes = Eigen::Vector3d::Constant(is_guided ? 0 : 1);
  for (const int axis : locked) axes[axis - X_AXIS] = 0;
  for (const int axis : free) axes[axis - X_AXIS] = 1;
  return axes;
}

}  // namespace

std::optional<WetSurface> wet_surface(const Scene& scene, std::size_t b, const fluid::Boundary& boundary) {
  const Body& body = scene.body(static_cast<int>(b));
  if (!protocol::is_ever_free(body)) return std::nullopt;
  const int dimension = static_cast<int>(scene.dimension());
  return WetSurface(
      boundary,
      {protocol::mass_properties(body, dimension), free_of(body, body.locked(), body.free()),
       free_of(body, body.locked_rotation(), body.free_rotation())},
      {dimension, scene.spacing(), protocol::heaviest_density(scene) * protocol::slowest_sound(scene)});
}

StabilityWatch::StabilityWatch(const Scene& scene, const CouplingPlan& plan,
                               std::vector<std::optional<WetSurface>> surfaces, double step)
    : scene_(scene),
      plan_(plan),
      surfaces_(std::move(surfaces)),
      exchange_(static_cast<double>(plan.coupling.steps_per_exchange()) * step),
      indicators_(surfaces_.size(), 0.0),
      saved_(indicators_),
      told_(surfaces_.size(), false) {}

bool StabilityWatch::is_due(std::uint64_t step, const protocol::StepClock& clock) const {
  const bool any =
      std::any_of(surfaces_.begin(), surfaces_.end(), [](const auto& s) { return s.has_value(); });
  return any && (step % kLookEvery == 0 || clock.is_output(step - 1));
}

void StabilityWatch::look(const std::vector<double>& liquid, std::span<const fluid::Kinematics> bodies,
                          double time) {
  for (std::size_t b = 0; b < surfaces_.size(); ++b) {
    if (!surfaces_[b]) continue;
    indicators_[b] = surfaces_[b]->rate(liquid, bodies[b]) * exchange_;
    const double allowed = plan_.stability[b].allowed();
    if (plan_.coupling.scheme() != EXPLICIT || indicators_[b] <= allowed || told_[b]) continue;
    told_[b] = true;
    tell(fmt::format(
        "body '{}' at t = {:g} s: with the surface that is wet now 2 rho c A t/m is {:.3g}, up to {:.3g} is "
        "stable; set coupling {{ scheme: AUTO }}, or fewer steps_per_exchange, or leave shorten_steps out",
        scene_.body(static_cast<int>(b)).name(), time, indicators_[b], allowed));
  }
}

void StabilityWatch::note(const Accepted& accepted, double time) {
  const sluice::Coupling& coupling = plan_.coupling;
  if (coupling.scheme() != IMPLICIT || accepted.residual() <= coupling.tolerance() || told_of_iterations_)
    return;
  told_of_iterations_ = true;
  tell(fmt::format(
      "the exchange that ended at t = {:g} s was given up after {} iterations, where one more would have "
      "changed {:.3g} of the impulse, above the tolerance of {:g}; set coupling.steps_per_exchange lower "
      "or coupling.most_iterations higher",
      time, accepted.iterations(), accepted.residual(), coupling.tolerance()));
}

void StabilityWatch::tell(const std::string& what) const {
  if (plan_.coupling.when_unstable() == REFUSE)
    throw Stop(End::UNSTABLE, what + "; or coupling.when_unstable: WARN, to go on all the same");
  spdlog::warn("{}", what);
}

}  // namespace sluice::server
