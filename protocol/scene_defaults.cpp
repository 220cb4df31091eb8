#include <algorithm>
#include <cmath>
#include <limits>

#include "protocol/field_check.hpp"
#include "protocol/formula.hpp"
#include "protocol/liquids.hpp"
#include "protocol/scene_check.hpp"

namespace sluice::protocol {
namespace {

void fill_zeros(Vector& vector, int count) {
  if (vector.empty()) vector.Resize(count, 0.0);
}

double norm(const Vector& vector) {
  double sum = 0;
  for (const double x : vector) sum += x * x;
  return std::sqrt(sum);
}

// A scene from a peer may lack entries; zero then.
double at(const Vector& vector, int axis) {
  return axis < vector.size() ? vector[axis] : 0;
}

double dot(const Vector& a, const Vector& b) {
  double sum = 0;
  for (int i = 0; i < a.size(); ++i) sum += a[i] * at(b, i);
  return sum;
}

// The largest of up.x over the region's points, for a unit vector `up`.
double top(const FluidRegion& region, const Vector& up) {
  double highest = -std::numeric_limits<double>::infinity();
  switch (region.shape_case()) {
    case FluidRegion::kBox: {
      double sum = 0;
      for (int a = 0; a < up.size(); ++a)
        sum += std::max(up[a] * at(region.box().min(), a), up[a] * at(region.box().max(), a));
      return sum;
    }
    case FluidRegion::kBall:
      return dot(region.ball().center(), up) + region.ball().radius();
    case FluidRegion::kPolygon:
      for (const auto& v : region.polygon().vertex())
        highest = std::max(highest, at(up, 0) * v.x() + at(up, 1) * v.y());
      return highest;
    default:
      return highest;
  }
}

// At time 0, against gravity from the origin [m]; nothing where no level is given, or one that is an error.
double level_of(const Inflow& inflow) {
  constexpr double kNone = -std::numeric_limits<double>::infinity();
  try {
    return inflow.level().empty() ? kNone : Formula(inflow.level(), true).at({0, 0, 0});
  } catch (const FormulaError&) {
    return kNone;
  }
}

// Height [m] of the highest liquid above the domain's lowest corner, against gravity.
double liquid_height(const Scene& scene, double g) {
  Vector up = scene.gravity();
  for (double& x : up) x /= -g;
  double floor = 0;
  for (int a = 0; a < up.size(); ++a)
    floor += std::min(up[a] * at(scene.domain().min(), a), up[a] * at(scene.domain().max(), a));
  double highest = floor;
  for (const auto& region : scene.fluid()) highest = std::max(highest, top(region, up));
  for (const auto& opening : scene.opening())
    if (opening.has_inflow()) highest = std::max(highest, level_of(opening.inflow()));
  return highest - floor;
}

double expected_speed(const Scene& scene) {
  const double g = norm(scene.gravity());
  double speed = g > 0 ? std::sqrt(2 * g * liquid_height(scene, g)) : 0;
  for (const auto& region : scene.fluid()) speed = std::max(speed, norm(region.velocity()));
  const Liquid& liquid = scene.liquid();
  return std::max(speed, std::sqrt(liquid.surface_tension() / (liquid.density() * scene.spacing())));
}

void fill_liquid(Scene& scene) {
  constexpr double kMachInverse = 10;  // density then stays within about 1 %
  Liquid& liquid = *scene.mutable_liquid();
  if (!liquid.has_density()) liquid.set_density(1000);
  if (!liquid.has_viscosity()) liquid.set_viscosity(0);
  if (!liquid.has_surface_tension()) liquid.set_surface_tension(0);
  if (!liquid.has_max_speed()) {
    const double speed = expected_speed(scene);
    liquid.set_max_speed(speed > 0 ? speed : liquid.sound_speed() / kMachInverse);
  }
  if (!liquid.has_sound_speed())
    liquid.set_sound_speed(kMachInverse * liquid.max_speed() *
                           std::sqrt(heaviest_density(scene) / liquid.density()));
}

void fill_opening(Opening& opening, const Domain& domain) {
  const int axis = (opening.side() - X_MIN) / 2;
  const auto fill = [axis](Vector& corner, const Vector& of_tank) {
    if (corner.empty())
      for (int a = 0; a < of_tank.size(); ++a)
        if (a != axis) corner.Add(of_tank[a]);
  };
  fill(*opening.mutable_min(), domain.min());
  fill(*opening.mutable_max(), domain.max());
}

void fill_body(Body& body, int dimension) {
  if (!body.has_prescribed()) {
    fill_zeros(*body.mutable_velocity(), dimension);
    fill_zeros(*body.mutable_angular_velocity(), dimension == 2 ? 1 : 3);
  }
  if (dimension == 3 && body.orientation().empty()) {
    for (const double q : {1.0, 0.0, 0.0, 0.0}) body.add_orientation(q);
  }
}

// Crowding is measured with the fit of MLS.
bool has_fit(const Formulation& formulation) {
  return formulation.approximation() == MLS && formulation.quadrature() == NODAL;
}

// Liquid that flies or turns with nothing around it: only its own motion can put it under tension.
bool is_in_free_flight(const Scene& scene) {
  return norm(scene.gravity()) == 0 && scene.body().empty() && scene.opening().empty() &&
         scene.domain().open_size() == 2 * static_cast<int>(scene.dimension()) &&
         scene.liquid().surface_tension() == 0;
}

void fill_shifting(Formulation& formulation, const Scene& scene) {
  const bool one_liquid = scene.other_liquid().empty();
  const bool flies = one_liquid && is_in_free_flight(scene) && has_fit(formulation) &&
                     formulation.boundary() != FORCES;  // not built for tension control
  const bool is_periodic = one_liquid && scene.domain().periodic_size() > 0;
  if (!formulation.has_tension_control()) formulation.set_tension_control(flies);
  if (!formulation.has_shifting()) formulation.set_shifting(flies ? 16 : is_periodic ? 6 : 0);
  const bool has_weight = one_liquid && norm(scene.gravity()) > 0;
  if (!formulation.has_spreading()) formulation.set_spreading(has_weight && has_fit(formulation) ? 0.02 : 0);
}

void fill_formulation(Formulation& formulation, unsigned dimension) {
  if (!formulation.has_smoothing()) formulation.set_smoothing(dimension == 2 ? 1.45 : 1.49);
  if (!formulation.has_density_diffusion()) formulation.set_density_diffusion(0.1);
  if (!formulation.has_artificial_viscosity()) formulation.set_artificial_viscosity(0.02);
  if (!formulation.has_moment_floor()) formulation.set_moment_floor(0.2);
  if (!formulation.has_courant()) formulation.set_courant(0.4);
  if (formulation.kernel() == KERNEL_UNSPECIFIED) formulation.set_kernel(WENDLAND);
  if (formulation.weights() == WEIGHTS_UNSPECIFIED) formulation.set_weights(KERNEL_AND_VOLUME);
  if (formulation.approximation() == APPROXIMATION_UNSPECIFIED) formulation.set_approximation(MLS);
  if (formulation.internal_force() == INTERNAL_FORCE_UNSPECIFIED) formulation.set_internal_force(GALERKIN);
  if (formulation.viscous_force() == VISCOUS_FORCE_UNSPECIFIED) formulation.set_viscous_force(STRESS);
  if (formulation.integrator() == INTEGRATOR_UNSPECIFIED) formulation.set_integrator(KICK_DRIFT_KICK);
  if (formulation.quadrature() == QUADRATURE_UNSPECIFIED) formulation.set_quadrature(NODAL);
  if (formulation.mass() == MASS_UNSPECIFIED) formulation.set_mass(PHYSICAL);
  if (formulation.boundary() == BOUNDARY_TREATMENT_UNSPECIFIED) formulation.set_boundary(LAYERS);
  if (!formulation.has_interpolated_motion()) formulation.set_interpolated_motion(0);
  if (!formulation.has_initial_parameters()) formulation.set_initial_parameters(false);
}

void fill_output(Output& output, double duration, bool several_liquids) {
  constexpr double kFrames = 100;
  if (!output.has_rate()) output.set_rate(kFrames / duration);
  if (!output.has_particles_every()) output.set_particles_every(1);
  if (output.precision() == PRECISION_UNSPECIFIED) output.set_precision(FLOAT64);
  if (output.field().empty()) {
    for (const ParticleField field : {POSITION, VELOCITY, DENSITY, PRESSURE}) output.add_field(field);
    if (several_liquids) output.add_field(LIQUID);
  }
}

void fill_coupling(Coupling& coupling) {
  if (coupling.scheme() == COUPLING_UNSPECIFIED) coupling.set_scheme(EXPLICIT);
  if (!coupling.has_steps_per_exchange()) coupling.set_steps_per_exchange(1);
  if (coupling.when_unstable() == WHEN_UNSTABLE_UNSPECIFIED) coupling.set_when_unstable(WARN);
  if (coupling.scheme() == EXPLICIT) {
    if (!coupling.has_shorten_steps()) coupling.set_shorten_steps(true);
    return;
  }
  if (!coupling.has_tolerance()) coupling.set_tolerance(1e-3);
  if (!coupling.has_most_iterations()) coupling.set_most_iterations(20);
}

}  // namespace

Scene with_defaults(const Scene& scene) {
  Scene full = scene;
  const int dimension = scene.dimension() == 3 ? 3 : 2;
  if (full.gravity().empty()) {
    fill_zeros(*full.mutable_gravity(), dimension);
    full.set_gravity(dimension - 1, -9.81);
  }
  fill_zeros(*full.mutable_domain()->mutable_min(), dimension);
  for (auto& region : *full.mutable_fluid()) {
    if (!region.has_velocity_field()) fill_zeros(*region.mutable_velocity(), dimension);
    if (!region.has_hydrostatic()) region.set_hydrostatic(region.pressure().empty());
  }
  fill_liquid(full);
  for (auto& opening : *full.mutable_opening()) fill_opening(opening, full.domain());
  for (auto& body : *full.mutable_body()) fill_body(body, dimension);
  const bool several = full.other_liquid_size() > 0;
  fill_output(*full.mutable_output(), full.duration(), several);
  fill_formulation(*full.mutable_formulation(), full.dimension());
  fill_shifting(*full.mutable_formulation(), full);
  fill_coupling(*full.mutable_coupling());
  return full;
}

}  // namespace sluice::protocol
