#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "protocol/field_check.hpp"
#include "protocol/liquids.hpp"
#include "protocol/scene_check.hpp"

namespace sluice::protocol {
namespace {

constexpr int kMostLiquids = 100;

std::vector<std::string> names(const Scene& scene) {
  std::vector<std::string> all;
  for (const OtherLiquid& other : scene.other_liquid()) all.push_back(other.name());
  return all;
}

void check_regions_of(const Scene& scene, FieldCheck& check) {
  for (int r = 0; r < scene.fluid_size(); ++r) {
    const std::string& name = scene.fluid(r).liquid();
    if (liquid_of(scene.fluid(r), scene)) continue;
    const std::vector<std::string> known = names(scene);
    check.report(fmt::format("fluid[{}].liquid", r),
                 fmt::format("no other_liquid is named \"{}\"; {}", name,
                             known.empty() ? "add one, or leave it out"
                                           : "they are " + fmt::format("{}", fmt::join(known, ", "))));
  }
}

void check_liquid(const Scene& scene, int k, FieldCheck& check) {
  const OtherLiquid& other = scene.other_liquid(k);
  const std::string field = fmt::format("other_liquid[{}]", k);
  check.positive(other.density(), field + ".density", "kg/m^3", "give the liquid's density");
  check.not_negative(other.viscosity(), field + ".viscosity", "Pa s");
  if (other.name().empty())
    return check.report(field + ".name", "is missing; regions name the liquid that they are of");
  for (int before = 0; before < k; ++before)
    if (scene.other_liquid(before).name() == other.name())
      check.report(field + ".name", fmt::format("\"{}\" is taken; choose another", other.name()));
  const bool is_used =
      std::any_of(scene.fluid().begin(), scene.fluid().end(),
                  [&](const FluidRegion& region) { return region.liquid() == other.name(); });
  if (!is_used)
    check.report(field,
                 fmt::format("no region is of it; give one liquid: \"{}\", or remove it", other.name()));
}

void check_ratio(const Scene& given, FieldCheck& check) {
  const std::vector<LiquidProperties> all = liquids(given);
  const auto [lightest, heaviest] = std::minmax_element(
      all.begin(), all.end(), [](const auto& a, const auto& b) { return a.density < b.density; });
  const double ratio = heaviest->density / lightest->density;
  if (!(lightest->density > 0) || ratio <= kLargestDensityRatio * (1 + 1e-9)) return;
  check.report(
      "other_liquid",
      fmt::format("{:g} kg/m^3 is {:.4g} times as heavy as {:g} kg/m^3; at most {:g} times is held at "
                  "rest: take a heavier light liquid, or leave it out as air is",
                  heaviest->density, ratio, lightest->density, kLargestDensityRatio));
}

// What is built for one liquid only.
void check_others(const Scene& given, FieldCheck& check) {
  const auto refuse = [&check](bool chosen, const std::string& field, const char* reason) {
    if (chosen) check.report(field, reason);
  };
  const Formulation& f = given.formulation();
  refuse(given.liquid().surface_tension() > 0, "liquid.surface_tension",
         "is built for the free surface of one liquid; leave it out or remove other_liquid");
  refuse(given.opening_size() > 0, "opening",
         "what comes in and leaves is built for one liquid; remove the openings or other_liquid");
  refuse(f.kernel() != WENDLAND, "formulation.kernel",
         "several liquids are built for WENDLAND; leave it out");
  refuse(f.approximation() != MLS, "formulation.approximation",
         "several liquids are built for MLS; leave it out");
  refuse(f.internal_force() != GALERKIN, "formulation.internal_force",
         "several liquids are built for GALERKIN; leave it out");
  refuse(f.viscous_force() != STRESS, "formulation.viscous_force",
         "several liquids are built for STRESS; leave it out");
  refuse(f.integrator() != KICK_DRIFT_KICK, "formulation.integrator",
         "several liquids are built for KICK_DRIFT_KICK; leave it out");
  refuse(f.quadrature() != NODAL, "formulation.quadrature",
         "several liquids are built for NODAL; leave it out");
  refuse(f.mass() != PHYSICAL, "formulation.mass",
         "LUMPED smears the densities of several liquids; leave it out");
  refuse(f.weights() != KERNEL_AND_VOLUME, "formulation.weights",
         "several liquids are built for KERNEL_AND_VOLUME; leave it out");
  refuse(f.interpolated_motion() > 0, "formulation.interpolated_motion",
         "moves one liquid with the other's velocity; leave it out");
  refuse(f.shifting() > 0, "formulation.shifting",
         "carries momentum from one liquid to the other; leave it out");
  refuse(f.spreading() > 0, "formulation.spreading",
         "carries momentum from one liquid to the other; leave it out");
  refuse(f.tension_control(), "formulation.tension_control",
         "takes its pressures across interfaces; leave it out");
}

}  // namespace

void check_other_liquids(const Scene& scene, FieldCheck& check) {
  check_regions_of(scene, check);
  if (scene.other_liquid().empty() || !check.count(scene.other_liquid_size(), kMostLiquids, "other_liquid"))
    return;
  for (int k = 0; k < scene.other_liquid_size(); ++k) check_liquid(scene, k, check);
  const Scene given = with_defaults(scene);
  check_ratio(given, check);
  check_others(given, check);
}

}  // namespace sluice::protocol
