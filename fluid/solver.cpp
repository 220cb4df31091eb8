#include "fluid/solver.hpp"

#include <algorithm>
#include <cmath>
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

void check_opening(const Setup& setup, const Opening& opening) {
  const auto side = static_cast<std::size_t>(opening.side);
  require(opening.side >= 0 && opening.side < 2 * setup.dimension, "side of an opening", opening.side,
          "of axis a it is 2 a (lower) or 2 a + 1 (upper)");
  require(setup.period.length[opening.side / 2] == 0 && !setup.mirrors.at[side], "side of an opening",
          opening.side, "it must neither be periodic nor a mirror");
  for (int a = 0; a < setup.dimension; ++a)
    require(a == opening.side / 2 || opening.max[a] - opening.min[a] >= setup.spacing,
            "size of an opening [m]", opening.max[a] - opening.min[a], "at least a spacing is needed");
  require(opening.inflow ? opening.speed || opening.level : !opening.speed, "speed given at an opening",
          opening.speed ? 1 : 0, "an inflow needs a speed or a level, an outflow takes that of the flow");
  require(!opening.pressure || !opening.level, "pressure and level given at an opening", 2,
          "it can have one of them");
  require(!opening.pressure || !opening.inflow || opening.speed, "speed given at an opening", 0,
          "an inflow of given pressure needs one");
  if (!opening.level) return;
  const double g = setup.gravity.norm();
  require(g > 0, "gravity [m/s^2]", g, "an opening of given level needs some");
  const double top = -setup.gravity.dot(opening.max) / g, bottom = -setup.gravity.dot(opening.min) / g;
  require(!opening.inflow || opening.level(0) > std::min(top, bottom), "level at an inflow [m]",
          opening.level(0), "it must be above the lower edge of the opening");
  require(!opening.inflow || opening.speed || opening.level(0) < std::max(top, bottom),
          "level at an inflow [m]", opening.level(0),
          "it must be below the upper edge of the opening where no speed is given");
}

void check_openings(const Setup& setup) {
  if (setup.openings.empty()) return;
  const Formulation& f = setup.formulation;
  require(setup.openings.size() < 256, "number of openings", static_cast<double>(setup.openings.size()),
          "at most 255 are built");
  require(f.integrator == Integrator::kick_drift_kick && f.quadrature == Quadrature::nodal &&
              f.interpolated_motion == 0,
          "integrator", static_cast<double>(f.integrator),
          "openings go with kick - drift - kick, 0, nodal quadrature and particles that move with their own "
          "velocity");
  for (const Opening& opening : setup.openings) check_opening(setup, opening);
}

void check_liquids(const Setup& setup) {
  const std::size_t numbers = setup.liquids.empty() ? 0 : setup.fluid.position.size();
  require(setup.fluid.liquid.size() == numbers, "liquids of particles",
          static_cast<double>(setup.fluid.liquid.size()),
          "with several liquids each particle has a number, else none");
  if (setup.liquids.empty()) return;
  const double stiffness = setup.liquid.density * setup.liquid.sound_speed * setup.liquid.sound_speed;
  for (const Liquid& liquid : setup.liquids) {
    require(liquid.density > 0 && liquid.density <= setup.liquid.density, "liquid density [kg/m^3]",
            liquid.density, "it must be positive, and that of Setup::liquid the largest");
    const double own = liquid.density * liquid.sound_speed * liquid.sound_speed;
    require(std::abs(own / stiffness - 1) < 1e-9, "density * sound_speed^2 [Pa]", own,
            "it must be that of Setup::liquid, for one pressure to mean one compression");
    require(liquid.viscosity >= 0, "viscosity [Pa s]", liquid.viscosity, "it must not be negative");
  }
  for (const std::uint8_t number : setup.fluid.liquid)
    require(number < setup.liquids.size(), "liquid of a particle", number,
            "it must be one of Setup::liquids");
  const Formulation& f = setup.formulation;
  require(f.kernel == KernelKind::wendland && f.approximation == Approximation::mls &&
              f.weights == Weights::kernel_and_volume && f.internal_force == InternalForce::galerkin &&
              f.viscous_force == ViscousForce::stress && f.integrator == Integrator::kick_drift_kick &&
              f.quadrature == Quadrature::nodal && f.mass == Mass::physical && f.interpolated_motion == 0 &&
              f.shifting == 0 && f.spreading == 0 && !f.tension_control && setup.openings.empty(),
          "number of liquids", static_cast<double>(setup.liquids.size()),
          "several are built for the default formulation without shifting, spreading, tension control and "
          "openings");
}

// A surface that pushes has no volume to hold an image, a plate's other side or shear in.
void check_boundary_forces(const Setup& setup) {
  const Formulation& f = setup.formulation;
  require(f.boundary_pressure >= 0, "boundary_pressure [Pa]", f.boundary_pressure, "it must not be negative");
  if (f.boundary == BoundaryTreatment::layers) return;
  const bool stepwise = f.integrator == Integrator::kick_drift_kick || f.integrator == Integrator::leap_frog;
  require(f.kernel == KernelKind::wendland && f.approximation == Approximation::mls &&
              f.weights == Weights::kernel_and_volume && f.internal_force == InternalForce::galerkin &&
              f.viscous_force == ViscousForce::stress && stepwise && f.quadrature == Quadrature::nodal &&
              f.mass == Mass::physical && !f.initial_parameters && !f.tension_control,
          "boundary", static_cast<double>(f.boundary),
          "forces, 1, go with the default formulation, the leap-frog and interpolated motion");
  require(setup.liquids.empty() && setup.openings.empty() && setup.liquid.surface_tension == 0, "boundary",
          static_cast<double>(f.boundary),
          "forces, 1, are built for one liquid without surface tension and openings");
  require(std::none_of(setup.mirrors.at.begin(), setup.mirrors.at.end(), [](bool mirror) { return mirror; }),
          "boundary", static_cast<double>(f.boundary), "forces, 1, need walls in the place of mirrors");
  const auto is_fit = [&setup](const Boundary& boundary) {
    return boundary.plates.empty() && !(boundary.no_slip && setup.has_viscous_stress());
  };
  require(is_fit(setup.walls) && std::all_of(setup.bodies.begin(), setup.bodies.end(), is_fit), "boundary",
          static_cast<double>(f.boundary), "forces, 1, are built for thick bodies along which liquid slides");
}

void check(const Setup& setup) {
  require(setup.dimension == 2 || setup.dimension == 3, "dimension", setup.dimension, "it must be 2 or 3");
  require(setup.spacing > 0, "spacing [m]", setup.spacing, "it must be positive");
  require(setup.threads >= 1, "threads", setup.threads, "at least one is needed");
  require(setup.liquid.density > 0, "liquid density [kg/m^3]", setup.liquid.density, "it must be positive");
  require(setup.liquid.sound_speed > 0, "speed of sound [m/s]", setup.liquid.sound_speed,
          "it must be positive");
  require(setup.liquid.viscosity >= 0, "viscosity [Pa s]", setup.liquid.viscosity, "it must not be negative");
  require(setup.liquid.surface_tension >= 0, "surface tension [N/m]", setup.liquid.surface_tension,
          "it must not be negative");
  require(setup.liquid.surface_tension == 0 || setup.liquids.empty(), "surface tension [N/m]",
          setup.liquid.surface_tension, "it is built for the free surface of one liquid");
  check_liquids(setup);
  const Formulation& f = setup.formulation;
  require(f.smoothing >= 1, "smoothing h/dx", f.smoothing, "at least 1, else neighbours are too few");
  require(f.courant > 0 && f.courant <= 1, "courant", f.courant, "it must be in (0, 1]");
  const bool wendland = f.kernel == KernelKind::wendland, mls = f.approximation == Approximation::mls;
  require(mls || wendland, "kernel", static_cast<double>(f.kernel),
          "other approximations than moving least squares are built with the Wendland kernel, 0");
  require(f.internal_force != InternalForce::isobaric || f.approximation == Approximation::sph,
          "approximation", static_cast<double>(f.approximation), "the isobaric pressure needs plain SPH, 3");
  require(f.internal_force != InternalForce::symmetrized || mls, "approximation",
          static_cast<double>(f.approximation), "the symmetrized force is built for moving least squares, 0");
  require(!f.tension_control || mls, "approximation", static_cast<double>(f.approximation),
          "tension control needs moving least squares, 0");
  require(
      f.quadrature == Quadrature::nodal ||
          (mls && wendland && f.internal_force == InternalForce::galerkin && !f.tension_control),
      "quadrature", static_cast<double>(f.quadrature),
      "other points than the particles, 1 and 2, go with moving least squares, the Wendland kernel and the "
      "Galerkin force");
  require(f.quadrature != Quadrature::background_cells ||
              (f.weights == Weights::kernel_and_volume && f.mass == Mass::physical),
          "quadrature", static_cast<double>(f.quadrature),
          "background cells, 2, go with volumes as weights and physical masses");
  check_boundary_forces(setup);
  const bool sum_one =
      f.approximation != Approximation::sph && f.approximation != Approximation::corrected_sph;
  const char* fitted = "it needs shape functions whose sum is one: moving least squares, 0, 1 or Shepard, 2";
  require(f.mass == Mass::physical || sum_one, "approximation", static_cast<double>(f.approximation), fitted);
  require(f.interpolated_motion >= 0 && f.interpolated_motion <= 1, "interpolated_motion",
          f.interpolated_motion, "it must be in [0, 1]");
  require(f.interpolated_motion == 0 || sum_one, "approximation", static_cast<double>(f.approximation),
          fitted);
  require(!f.initial_parameters || f.interpolated_motion > 0, "interpolated_motion", f.interpolated_motion,
          "initial parameters need particles that move with the interpolated velocity");
  require(f.viscous_force == ViscousForce::stress || (wendland && setup.liquid.viscosity > 0),
          "viscosity [Pa s]", setup.liquid.viscosity,
          "the damped viscosity needs some, and the Wendland kernel");
  require(
      setup.liquid.surface_tension == 0 ||
          (mls && f.internal_force == InternalForce::galerkin && f.quadrature == Quadrature::nodal &&
           f.weights == Weights::kernel_and_volume && f.mass == Mass::physical),
      "surface tension [N/m]", setup.liquid.surface_tension,
      "it is built for the Galerkin force of moving least squares with nodal quadrature, volumes as weights "
      "and physical masses");
  require(f.isobaric_scale > 0, "isobaric_scale", f.isobaric_scale, "it must be positive");
  require(f.moment_floor > 0 && f.moment_floor < 1, "moment_floor", f.moment_floor, "it must be in (0, 1)");
  const std::size_t n = setup.fluid.position.size();
  const bool is_fed = std::any_of(setup.openings.begin(), setup.openings.end(),
                                  [](const Opening& opening) { return opening.inflow; });
  require(n > 0 || is_fed, "number of fluid particles", 0,
          "a run needs some: is a region smaller than the spacing?");
  require(setup.fluid.velocity.size() == n && setup.fluid.pressure.size() == n, "fluid particles",
          static_cast<double>(n), "velocity and pressure must be given for each");
  require(setup.fluid.volume > 0, "particle volume [m^Dim]", setup.fluid.volume, "it must be positive");
  check_openings(setup);
}

template <template <int> typename Kernel>
std::unique_ptr<Solver> make(const Setup& setup) {
  if (setup.dimension == 2) return std::make_unique<GalerkinSolver<2, Kernel<2>>>(setup);
  return std::make_unique<GalerkinSolver<3, Kernel<3>>>(setup);
}

template <int Dim>
using FullDerivative = WithFullDerivative<WendlandC2<Dim>>;
template <int Dim>
using ShepardSum = WithShepard<WendlandC2<Dim>>;
template <int Dim>
using PlainSph = WithSph<WendlandC2<Dim>>;
template <int Dim>
using CorrectedSum = WithCorrectedSph<WendlandC2<Dim>>;
template <int Dim>
using PointQuadrature = WithStressPoints<WendlandC2<Dim>>;
template <int Dim>
using IsobaricSum = WithIsobaricSph<WendlandC2<Dim>>;

std::unique_ptr<Solver> make_with_operator(const Setup& setup) {
  switch (setup.formulation.approximation) {
    case Approximation::mls_full_derivative:
      return make<FullDerivative>(setup);
    case Approximation::shepard:
      return make<ShepardSum>(setup);
    case Approximation::sph:
      if (setup.formulation.internal_force == InternalForce::isobaric) return make<IsobaricSum>(setup);
      return make<PlainSph>(setup);
    case Approximation::corrected_sph:
      return make<CorrectedSum>(setup);
    case Approximation::mls:
      if (setup.formulation.quadrature == Quadrature::stress_points) return make<PointQuadrature>(setup);
  }
  return make<WendlandC2>(setup);
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
  return make_with_operator(setup);
}

}  // namespace sluice::fluid
