#include "server/initial_fields.hpp"

#include <fmt/format.h>

#include "protocol/liquids.hpp"
#include "server/geometry.hpp"

namespace sluice::server {

namespace {

fluid::EquationOfState equation_of(const Scene& scene, const FluidRegion& region) {
  const protocol::LiquidProperties liquid =
      protocol::liquids(scene)[protocol::liquid_of(region, scene).value()];
  return {liquid.density, liquid.sound_speed};
}

// g H of a region's highest point.
double top(const FluidRegion& given, const Eigen::Vector3d& gravity) {
  const Region region = to_region(given);
  return support(region.shape, -gravity) - gravity.dot(region.center);
}

bool holds(const FluidRegion& given, const Eigen::Vector3d& x, int dimension) {
  const Region region = to_region(given);
  return fluid::signed_distance(region.shape, x - region.center, dimension) < 0;
}

// Hydrostatic pressure of region r at x: with the density that the pressure makes, below the pressure at the
// region's highest level, which is zero or that of the region that stands there above x. CF (65) has the
// pressure of an incompressible column, with which the start is not quite at rest.
double hydrostatic_pressure(const Scene& scene, int r, const fluid::EquationOfState& eos,
                            const Eigen::Vector3d& gravity, const Eigen::Vector3d& x) {
  const double g_height = top(scene.fluid(r), gravity);
  if (scene.other_liquid().empty()) return eos.pressure(eos.hydrostatic_density(g_height + gravity.dot(x)));
  const Eigen::Vector3d up = -gravity.normalized();
  const Eigen::Vector3d level = x + (g_height / gravity.norm() - up.dot(x)) * up;
  double on_top = 0;
  for (int other = 0; other < scene.fluid_size(); ++other) {
    const FluidRegion& region = scene.fluid(other);
    if (other == r || !region.hydrostatic() || top(region, gravity) <= g_height ||
        !holds(region, level + 1e-3 * scene.spacing() * up, static_cast<int>(scene.dimension())))
      continue;
    on_top = hydrostatic_pressure(scene, other, equation_of(scene, region), gravity, level);
  }
  return eos.pressure(eos.hydrostatic_density(eos.head(on_top) + g_height + gravity.dot(x)));
}

}  // namespace

InitialFields::InitialFields(const Scene& scene, int region)
    : scene_(scene),
      region_(scene.fluid(region)),
      number_(region),
      eos_(equation_of(scene, scene.fluid(region))),
      gravity_(to_vector(scene.gravity())),
      displacement_(parse(fmt::format("fluid[{}].displacement", region), region_.displacement())),
      velocity_(parse(fmt::format("fluid[{}].velocity_field", region), region_.velocity_field())),
      pressure_(parse(fmt::format("fluid[{}].pressure", region), region_.pressure())) {}

InitialFields::NamedFormula InitialFields::parse(const std::string& field, const std::string& text) {
  try {
    return {field, protocol::Formula(text)};
  } catch (const protocol::FormulaError& error) {
    throw protocol::SceneError(field, error.what());
  }
}

InitialFields::VectorFormula InitialFields::parse(const std::string& field, const Field& formulas) {
  return {parse(field + ".x", formulas.x()), parse(field + ".y", formulas.y()),
          parse(field + ".z", formulas.z())};
}

double InitialFields::NamedFormula::at(const Eigen::Vector3d& x) const {
  try {
    return formula.at({x.x(), x.y(), x.z()});
  } catch (const protocol::FormulaError& error) {
    throw protocol::SceneError(field, error.what());
  }
}

Eigen::Vector3d InitialFields::at(const VectorFormula& formula, const Eigen::Vector3d& x) {
  return {formula[0].at(x), formula[1].at(x), formula[2].at(x)};
}

Eigen::Vector3d InitialFields::displacement(const Eigen::Vector3d& x) const {
  return at(displacement_, x);
}

Eigen::Vector3d InitialFields::velocity(const Eigen::Vector3d& x) const {
  return region_.has_velocity_field() ? at(velocity_, x) : to_vector(region_.velocity());
}

double InitialFields::pressure(const Eigen::Vector3d& x) const {
  if (region_.pressure().empty()) {
    if (!region_.hydrostatic() || gravity_.isZero(0)) return 0;
    return hydrostatic_pressure(scene_, number_, eos_, gravity_, x);
  }
  const double p = pressure_.at(x);
  if (p <= -eos_.kappa())
    throw protocol::SceneError(
        pressure_.field,
        fmt::format("formula '{}' is {:g} Pa at ({:g}, {:g}, {:g}) m; the liquid has no density for tension "
                    "beyond density * sound_speed^2 / 7, {:g} Pa: take a larger liquid.sound_speed",
                    region_.pressure(), p, x.x(), x.y(), x.z(), eos_.kappa()));
  return p;
}

}  // namespace sluice::server
