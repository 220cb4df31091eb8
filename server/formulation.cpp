#include "server/formulation.hpp"

namespace sluice::server {

namespace {

fluid::KernelKind to_kernel(KernelKind kernel) {
  switch (kernel) {
    case CUBIC_SPLINE:
      return fluid::KernelKind::cubic_spline;
    case TENSOR_SPLINE:
      return fluid::KernelKind::tensor_spline;
    case SINC_SQUARED:
      return fluid::KernelKind::sinc_squared;
    default:
      return fluid::KernelKind::wendland;
  }
}

fluid::Approximation to_approximation(Approximation approximation) {
  switch (approximation) {
    case MLS_FULL_DERIVATIVE:
      return fluid::Approximation::mls_full_derivative;
    case SHEPARD:
      return fluid::Approximation::shepard;
    case SPH:
      return fluid::Approximation::sph;
    case CORRECTED_SPH:
      return fluid::Approximation::corrected_sph;
    default:
      return fluid::Approximation::mls;
  }
}

fluid::InternalForce to_internal_force(InternalForce force) {
  switch (force) {
    case SYMMETRIZED:
      return fluid::InternalForce::symmetrized;
    case ISOBARIC:
      return fluid::InternalForce::isobaric;
    default:
      return fluid::InternalForce::galerkin;
  }
}

fluid::Integrator to_integrator(Integrator integrator) {
  switch (integrator) {
    case LEAP_FROG:
      return fluid::Integrator::leap_frog;
    case PREDICTOR_CORRECTOR:
      return fluid::Integrator::predictor_corrector;
    case MULTISTEP:
      return fluid::Integrator::multistep;
    default:
      return fluid::Integrator::kick_drift_kick;
  }
}

fluid::Quadrature to_quadrature(Quadrature quadrature) {
  switch (quadrature) {
    case STRESS_POINTS:
      return fluid::Quadrature::stress_points;
    case BACKGROUND_CELLS:
      return fluid::Quadrature::background_cells;
    default:
      return fluid::Quadrature::nodal;
  }
}

}  // namespace

fluid::Formulation to_formulation(const Formulation& formulation) {
  fluid::Formulation result;
  if (formulation.has_smoothing()) result.smoothing = formulation.smoothing();
  if (formulation.has_density_diffusion()) result.density_diffusion = formulation.density_diffusion();
  if (formulation.has_artificial_viscosity())
    result.artificial_viscosity = formulation.artificial_viscosity();
  if (formulation.has_moment_floor()) result.moment_floor = formulation.moment_floor();
  if (formulation.has_courant()) result.courant = formulation.courant();
  if (formulation.has_shifting()) result.shifting = formulation.shifting();
  if (formulation.has_spreading()) result.spreading = formulation.spreading();
  if (formulation.has_tension_control()) result.tension_control = formulation.tension_control();
  result.kernel = to_kernel(formulation.kernel());
  if (formulation.weights() == KERNEL_ALONE) result.weights = fluid::Weights::kernel;
  result.approximation = to_approximation(formulation.approximation());
  result.internal_force = to_internal_force(formulation.internal_force());
  if (formulation.has_isobaric_scale()) result.isobaric_scale = formulation.isobaric_scale();
  if (formulation.viscous_force() == DAMPED) result.viscous_force = fluid::ViscousForce::damped;
  result.integrator = to_integrator(formulation.integrator());
  if (formulation.has_multistep_beta1()) result.multistep_beta1 = formulation.multistep_beta1();
  if (formulation.has_multistep_beta2()) result.multistep_beta2 = formulation.multistep_beta2();
  result.quadrature = to_quadrature(formulation.quadrature());
  if (formulation.mass() == LUMPED) result.mass = fluid::Mass::lumped;
  if (formulation.has_interpolated_motion()) result.interpolated_motion = formulation.interpolated_motion();
  if (formulation.has_initial_parameters()) result.initial_parameters = formulation.initial_parameters();
  if (formulation.boundary() == FORCES) result.boundary = fluid::BoundaryTreatment::forces;
  if (formulation.has_boundary_pressure()) result.boundary_pressure = formulation.boundary_pressure();
  if (formulation.has_force_on_receding()) result.force_on_receding = formulation.force_on_receding();
  return result;
}

}  // namespace sluice::server
