#include "fluid/galerkin_stages.hpp"
#include "fluid/kernel.hpp"

namespace sluice::fluid {

template class GalerkinSolver<2, CubicSpline<2>>;
template class GalerkinSolver<3, CubicSpline<3>>;

}  // namespace sluice::fluid
