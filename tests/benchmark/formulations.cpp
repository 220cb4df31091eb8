#include "benchmark/formulations.hpp"

namespace sluice::benchmark {

const std::vector<Formulation>& all_formulations() {
  static const std::vector<Formulation> formulations{
      {"default", "the defaults", {}},
      {"h1.3", "smoothing length 1.3 spacings", {"formulation.smoothing=1.3"}},
      {"h1.5", "smoothing length 1.5 spacings", {"formulation.smoothing=1.5"}},
      {"alpha0.05", "artificial viscosity 0.05", {"formulation.artificial_viscosity=0.05"}},
      {"cubic", "cubic spline kernel CF (18)", {"formulation.kernel=CUBIC_SPLINE"}},
      {"tensor", "tensor-product spline kernel CF (19)", {"formulation.kernel=TENSOR_SPLINE"}},
      {"sinc2", "sinc squared kernel PC (19)", {"formulation.kernel=SINC_SQUARED"}},
      {"w", "weights CF (12), kernel alone", {"formulation.weights=KERNEL_ALONE"}},
      {"full",
       "full derivative of the shape functions CF (15)",
       {"formulation.approximation=MLS_FULL_DERIVATIVE"}},
      {"shepard", "constant basis", {"formulation.approximation=SHEPARD"}},
      {"sph", "plain SPH, CF (1) with (102) and (105)", {"formulation.approximation=SPH"}},
      {"corrected_sph", "SPH with corrected gradients", {"formulation.approximation=CORRECTED_SPH"}},
      {"isobaric",
       "pressure term PC (13)-(16)",
       {"formulation.approximation=SPH", "formulation.internal_force=ISOBARIC"}},
      {"symmetrized", "internal force CF (105)", {"formulation.internal_force=SYMMETRIZED"}},
      {"damped", "damped viscosity PC (17)-(18)", {"formulation.viscous_force=DAMPED"}},
      {"leap_frog", "CF04 (37)-(39)", {"formulation.integrator=LEAP_FROG"}},
      {"predictor_corrector", "CF (108)-(110)", {"formulation.integrator=PREDICTOR_CORRECTOR"}},
      {"multistep",
       "PC (26)-(27), Courant number 0.2",
       {"formulation.integrator=MULTISTEP", "formulation.courant=0.2"}},
      {"stress_points", "stress points CF (54)", {"formulation.quadrature=STRESS_POINTS"}},
      {"background_cells", "points of a fixed grid CF (46)", {"formulation.quadrature=BACKGROUND_CELLS"}},
      {"lumped", "lumped mass CF (56)", {"formulation.mass=LUMPED"}},
      {"interpolated",
       "motion with the interpolated velocity CF (75)",
       {"formulation.interpolated_motion=1"}},
      {"half_interpolated", "half of it", {"formulation.interpolated_motion=0.5"}},
      {"initial_parameters",
       "the same with the initial parameters CF (99)",
       {"formulation.interpolated_motion=1", "formulation.initial_parameters=true"}},
      {"boundary_forces", "boundary forces CF (98), (111)-(113)", {"formulation.boundary=FORCES"}},
      {"boundary_forces_always",
       "the same on liquid that recedes too",
       {"formulation.boundary=FORCES", "formulation.force_on_receding=true"}},
      {"tension_control",
       "pressures under tension relative to the particle's own",
       {"formulation.tension_control=true"}},
      {"delta0.05", "density diffusion 0.05", {"formulation.density_diffusion=0.05"}},
  };
  return formulations;
}

}  // namespace sluice::benchmark
