#include "fluid/galerkin_stages.hpp"
#include "fluid/kernel.hpp"

namespace sluice::fluid {

template class GalerkinSolver<2, TensorSpline<2>>;
template class GalerkinSolver<3, TensorSpline<3>>;

}  // namespace sluice::fluid
