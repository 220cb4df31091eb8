#include <fmt/format.h>

#include "protocol/field_check.hpp"

namespace sluice::protocol {
namespace {

// Of the formulation: what the forces are built for.
void check_choices(const Formulation& f, FieldCheck& check) {
  const auto refuse = [&check](int given, int built, const char* field, const char* reason) {
    if (given != 0 && given != built) check.report(std::string("formulation.") + field, reason);
  };
  refuse(f.kernel(), WENDLAND, "kernel", "boundary FORCES are built for WENDLAND; leave one of them out");
  refuse(f.approximation(), MLS, "approximation",
         "boundary FORCES are handed on by the shape functions of MLS; leave one of them out");
  refuse(f.weights(), KERNEL_AND_VOLUME, "weights",
         "boundary FORCES are built for KERNEL_AND_VOLUME; leave one of them out");
  refuse(f.internal_force(), GALERKIN, "internal_force",
         "boundary FORCES stand in the Galerkin form, CF (98); leave one of them out");
  refuse(f.viscous_force(), STRESS, "viscous_force",
         "DAMPED acts between liquid and the volumes of a boundary, which FORCES have not; leave one of them "
         "out");
  refuse(f.quadrature(), NODAL, "quadrature", "boundary FORCES are built for NODAL; leave one of them out");
  refuse(f.mass(), PHYSICAL, "mass",
         "LUMPED counts the volumes of a boundary, which FORCES have not; leave one of them out");
  refuse(f.integrator() == LEAP_FROG ? KICK_DRIFT_KICK : f.integrator(), KICK_DRIFT_KICK, "integrator",
         "boundary FORCES ask for the velocities of the middle of a step; take KICK_DRIFT_KICK or LEAP_FROG");
  refuse(f.initial_parameters(), false, "initial_parameters",
         "boundary FORCES are built without; leave one of them out");
  refuse(f.tension_control(), false, "tension_control",
         "takes pressures from the volumes of a boundary, which FORCES have not; leave one of them out");
}

// Along a surface the forces do nothing.
void check_surfaces(const Scene& scene, FieldCheck& check) {
  const char* slides =
      "boundary FORCES act across surfaces only, and liquid slides along them; leave this out";
  if (scene.domain().surface() == NO_SLIP) check.report("domain.surface", slides);
  if (scene.domain().moving_size() > 0) check.report("domain.moving[0]", slides);
  for (int b = 0; b < scene.body_size(); ++b)
    if (scene.body(b).surface() == NO_SLIP) check.report(fmt::format("body[{}].surface", b), slides);
}

}  // namespace

void check_boundary_forces(const Scene& scene, FieldCheck& check) {
  check_choices(scene.formulation(), check);
  check_surfaces(scene, check);
  if (scene.liquid().surface_tension() > 0)
    check.report("liquid.surface_tension",
                 "counts walls as liquid, and boundary FORCES have no volume; leave one of them out");
  if (scene.other_liquid_size() > 0)
    check.report("other_liquid[0]", "boundary FORCES are built for one liquid; leave one of them out");
  if (scene.opening_size() > 0)
    check.report("opening[0]", "is built in walls of LAYERS; leave formulation.boundary out");
}

}  // namespace sluice::protocol
