#include "server/initial_fields.hpp"

#include <fmt/format.h>

#include "fluid/equation_of_state.hpp"
#include "server/geometry.hpp"

namespace sluice::server {

InitialFields::InitialFields(const Scene& scene, int region)
    : scene_(scene),
      region_(scene.fluid(region)),
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
  if (region_.pressure().empty()) return region_.hydrostatic() ? hydrostatic(x) : 0;
  const fluid::EquationOfState eos(scene_.liquid().density(), scene_.liquid().sound_speed());
  const double p = pressure_.at(x);
  if (p <= -eos.kappa())
    throw protocol::SceneError(
        pressure_.field,
        fmt::format("formula '{}' is {:g} Pa at ({:g}, {:g}, {:g}) m; the liquid has no density for tension "
                    "beyond density * sound_speed^2 / 7, {:g} Pa: take a larger liquid.sound_speed",
                    region_.pressure(), p, x.x(), x.y(), x.z(), eos.kappa()));
  return p;
}

// With the density that the pressure makes: z the height of x against gravity, H that of the region's highest
// point. CF (65) has the pressure of an incompressible column, with which the start is not quite at rest.
double InitialFields::hydrostatic(const Eigen::Vector3d& x) const {
  const Eigen::Vector3d g = to_vector(scene_.gravity());
  if (g.isZero(0)) return 0;
  const Region region = to_region(region_);
  const double g_height = support(region.shape, -g) - g.dot(region.center);  // g H
  const fluid::EquationOfState eos(scene_.liquid().density(), scene_.liquid().sound_speed());
  return eos.pressure(eos.hydrostatic_density(g_height + g.dot(x)));
}

}  // namespace sluice::server
