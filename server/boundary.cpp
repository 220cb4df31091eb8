#include "server/boundary.hpp"

#include <fmt/format.h>

#include "protocol/error.hpp"
#include "server/geometry.hpp"

namespace sluice::server {
namespace {

bool has_forces(const fluid::Setup& setup) {
  return setup.formulation.boundary == fluid::BoundaryTreatment::forces;
}

}  // namespace

double kernel_support(const fluid::Setup& setup) {
  return 2 * setup.formulation.smoothing * setup.spacing;
}

// Past periodic sides walls go on as far as the forces, r0, and the neighbour lists' skin: together 0.9 h.
fluid::Boundary wall_boundary(const fluid::Tank& tank, const fluid::Setup& setup) {
  const double support = kernel_support(setup);
  if (!has_forces(setup)) return fluid::sample_walls(tank, setup.spacing, support, setup.dimension);
  fluid::Boundary walls = fluid::sample_wall_surface(tank, setup.spacing, support / 2, setup.dimension);
  walls.no_slip = tank.no_slip;
  return walls;
}

// With forces nothing keeps liquid on opposite sides apart but the body's thickness.
fluid::Boundary body_boundary(const Body& body, const fluid::Setup& setup) {
  const double support = kernel_support(setup);
  const fluid::Shape shape = to_shape(body, setup.dimension);
  if (!has_forces(setup)) return fluid::sample_body(shape, setup.spacing, support, setup.dimension);
  const double thickness = fluid::thickness(shape, setup.dimension);
  if (thickness < support)
    throw protocol::InputError(fmt::format(
        "body '{}' is {:g} m thick, and through less than the support of {:g} m liquid on opposite "
        "sides interacts: formulation.boundary FORCES has no thin plates; make the body thicker, the "
        "spacing smaller, or leave boundary out",
        body.name(), thickness, support));
  return fluid::sample_body_surface(shape, setup.spacing, setup.dimension);
}

}  // namespace sluice::server
