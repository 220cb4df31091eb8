#include "fluid/galerkin_stages.hpp"
#include "fluid/kernel.hpp"

namespace sluice::fluid {

template class GalerkinSolver<2, WithIsobaricSph<WendlandC2<2>>>;
template class GalerkinSolver<3, WithIsobaricSph<WendlandC2<3>>>;

}  // namespace sluice::fluid
