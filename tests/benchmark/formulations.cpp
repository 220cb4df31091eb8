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
      {"tension_control",
       "pressures under tension relative to the particle's own",
       {"formulation.tension_control=true"}},
      {"delta0.05", "density diffusion 0.05", {"formulation.density_diffusion=0.05"}},
  };
  return formulations;
}

}  // namespace sluice::benchmark
