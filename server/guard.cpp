#include "server/guard.hpp"

#include <fmt/format.h>

#include <cmath>

#include "server/geometry.hpp"
#include "server/stop.hpp"

namespace sluice::server {

namespace {

constexpr double kLargestCompression = 0.5;  // |rho/rho0 - 1|

Eigen::Vector3d vector_of(const std::vector<double>& values, std::size_t particle) {
  return {values[3 * particle], values[3 * particle + 1], values[3 * particle + 2]};
}

}  // namespace

Guard::Guard(const Scene& scene) : scene_(scene), liquids_(protocol::liquids(scene)) {
  const Eigen::Vector3d lower = to_vector(scene.domain().min()), upper = to_vector(scene.domain().max());
  min_ = lower - (upper - lower);
  max_ = upper + (upper - lower);
}

void Guard::check(const fluid::Snapshot& state, double time) const {
  for (std::size_t i = 0; i < state.density.size(); ++i) {
    const std::string reason = fault(state, i);
    if (reason.empty()) continue;
    const Eigen::Vector3d x = vector_of(state.position, i);
    throw Stop(End::UNSTABLE, fmt::format("particle {} at ({:g}, {:g}, {:g}) m, t = {:g} s: {}", state.id[i],
                                          x.x(), x.y(), x.z(), time, reason));
  }
}

void Guard::check(std::span<const fluid::Wrench> wrenches, double time) const {
  for (std::size_t b = 0; b < wrenches.size(); ++b) {
    if (wrenches[b].force.allFinite() && wrenches[b].moment.allFinite()) continue;
    throw Stop(End::UNSTABLE, fmt::format("the fluid's force on body \"{}\" is not finite at t = {:g} s",
                                          scene_.body(static_cast<int>(b)).name(), time));
  }
}

std::string Guard::fault(const fluid::Snapshot& state, std::size_t i) const {
  const Eigen::Vector3d x = vector_of(state.position, i), v = vector_of(state.velocity, i);
  const double density = state.density[i], speed = v.norm();
  if (!x.allFinite() || !std::isfinite(speed) || !std::isfinite(density) ||
      !std::isfinite(state.pressure[i])) {
    return fmt::format("its state is not finite (speed {:g} m/s, density {:g} kg/m^3, pressure {:g} Pa)",
                       speed, density, state.pressure[i]);
  }
  const auto& [rho0, viscosity, sound_speed] = liquids_[state.liquid.empty() ? 0 : state.liquid[i]];
  if (std::abs(density / rho0 - 1) > kLargestCompression) {
    return fmt::format("its density {:g} kg/m^3 is off {:g} kg/m^3 by more than half", density, rho0);
  }
  if (speed > sound_speed) {
    return fmt::format("its speed {:g} m/s is above the speed of sound {:g} m/s; raise liquid.max_speed",
                       speed, sound_speed);
  }
  for (int a = 0; a < static_cast<int>(scene_.dimension()); ++a) {
    if (x[a] < min_[a] || x[a] > max_[a]) return "it is further outside the tank than the tank is large";
  }
  return {};
}

}  // namespace sluice::server
