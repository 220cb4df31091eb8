#include "clients/sluice/not_computed.hpp"

#include <algorithm>

#include "protocol/liquids.hpp"

namespace sluice::clients {
namespace {

bool is_viscous(const Scene& scene) {
  return std::ranges::any_of(protocol::liquids(scene),
                             [](const auto& liquid) { return liquid.viscosity > 0; });
}

}  // namespace

std::vector<std::string> not_computed(const Scene& scene, bool is_recorded) {
  std::vector<std::string> names;
  const auto leave_out = [&names](bool is_needed, const char* name) {
    if (!is_needed) names.emplace_back(name);
  };
  leave_out(scene.dimension() == 3, "third dimension");
  leave_out(is_viscous(scene), "viscosity");
  leave_out(scene.liquid().surface_tension() > 0, "surface tension");
  leave_out(scene.other_liquid_size() > 0, "second liquid");
  leave_out(scene.formulation().shifting() > 0, "shifting");
  leave_out(scene.formulation().tension_control(), "tension control");
  leave_out(scene.domain().periodic_size() > 0, "periodic images");
  leave_out(scene.opening_size() > 0, "openings");
  leave_out(scene.body_size() > 0, "bodies");
  leave_out(scene.probe_size() > 0, "probes");
  leave_out(is_recorded, "frames");
  return names;
}

}  // namespace sluice::clients
