#include "fluid/solver.hpp"

#include <sstream>
#include <stdexcept>
#include <string>

#include "fluid/galerkin_solver.hpp"
#include "fluid/kernel.hpp"

namespace sluice::fluid {

namespace {

void require(bool condition, const std::string& name, double value, const char* allowed) {
  if (condition) return;
  std::ostringstream text;
  text << "fluid setup: " << name << " is " << value << "; " << allowed;
  throw std::invalid_argument(text.str());
}

void check(const Setup& setup) {
  require(setup.dimension == 2 || setup.dimension == 3, "dimension", setup.dimension, "it must be 2 or 3");
  require(setup.spacing > 0, "spacing [m]", setup.spacing, "it must be positive");
  require(setup.threads >= 1, "threads", setup.threads, "at least one is needed");
  require(setup.liquid.density > 0, "liquid density [kg/m^3]", setup.liquid.density, "it must be positive");
  require(setup.liquid.sound_speed > 0, "speed of sound [m/s]", setup.liquid.sound_speed,
          "it must be positive");
  require(setup.liquid.viscosity >= 0, "viscosity [Pa s]", setup.liquid.viscosity, "it must not be negative");
  const Formulation& f = setup.formulation;
  require(f.smoothing >= 1, "smoothing h/dx", f.smoothing, "at least 1, else neighbours are too few");
  require(f.courant > 0 && f.courant <= 1, "courant", f.courant, "it must be in (0, 1]");
  require(f.moment_floor > 0 && f.moment_floor < 1, "moment_floor", f.moment_floor, "it must be in (0, 1)");
  const std::size_t n = setup.fluid.position.size();
  require(n > 0, "number of fluid particles", 0, "a run needs some: is a region smaller than the spacing?");
  require(setup.fluid.velocity.size() == n && setup.fluid.pressure.size() == n, "fluid particles",
          static_cast<double>(n), "velocity and pressure must be given for each");
  require(setup.fluid.volume > 0, "particle volume [m^Dim]", setup.fluid.volume, "it must be positive");
}

template <template <int> typename Kernel>
std::unique_ptr<Solver> make(const Setup& setup) {
  if (setup.dimension == 2) return std::make_unique<GalerkinSolver<2, Kernel<2>>>(setup);
  return std::make_unique<GalerkinSolver<3, Kernel<3>>>(setup);
}

}  // namespace

std::unique_ptr<Solver> make_solver(const Setup& setup) {
  check(setup);
  switch (setup.formulation.kernel) {
    case KernelKind::cubic_spline:
      return make<CubicSpline>(setup);
    case KernelKind::tensor_spline:
      return make<TensorSpline>(setup);
    case KernelKind::sinc_squared:
      return make<SincSquared>(setup);
    case KernelKind::wendland:
      break;
  }
  return make<WendlandC2>(setup);
}

}  // namespace sluice::fluid
