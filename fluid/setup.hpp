#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <vector>

namespace sluice::fluid {

struct Liquid {
  double density = 1000;       // at zero pressure, rho0 [kg/m^3]
  double viscosity = 0;        // dynamic, mu [Pa s]; 0: not computed
  double sound_speed = 0;      // c0 [m/s]
  double surface_tension = 0;  // of the free surface, sigma [N/m]; 0: none. For one liquid only
};

// h/dx at which the square (2D) or cubic (3D) lattice under pressure is stable against displacements of every
// wave vector, with the Wendland kernel. The window is narrow, 1.446 to 1.453 and 1.48 to 1.505: outside it
// rows of particles slide past each other (README.md, "The lattice under pressure").
constexpr double stable_smoothing(int dimension) {
  return dimension == 2 ? 1.45 : 1.49;
}

enum class KernelKind { wendland, cubic_spline, tensor_spline, sinc_squared };  // kernel.hpp

// What weighs the neighbours in the moments: their volume as well, CF (11), or the kernel alone, CF (12).
enum class Weights { kernel_and_volume, kernel };

// How the derivative of a shape function follows from the kernel (approximation.hpp).
enum class Approximation { mls, mls_full_derivative, shepard, sph, corrected_sph };

// CF (43); the comparator CF (105); PC (13)-(16).
enum class InternalForce { galerkin, symmetrized, isobaric };

// The stress of CF (60) in the internal force; PC (17)-(18).
enum class ViscousForce { stress, damped };

enum class Integrator { kick_drift_kick, leap_frog, predictor_corrector, multistep };  // integrators.hpp

// Where the stress is taken: at the particles, CF (43), at points around them, CF (54), or at those of a
// fixed grid, CF (46) and fig. 1.
enum class Quadrature { nodal, stress_points, background_cells };

// What walls and bodies are to the fluid: layers of particles that fill its support, or one of particles on
// the surface that push it, CF (90)-(98) (boundary_forces.hpp).
enum class BoundaryTreatment { layers, forces };

// What the force on a particle is divided by: its mass, CF (58), or the lumped mass of the weak form, CF
// (56).
enum class Mass { physical, lumped };

// Numerical parameters; README.md, "Parameters", has the measurements behind the defaults.
struct Formulation {
  KernelKind kernel = KernelKind::wendland;
  Weights weights = Weights::kernel_and_volume;
  Approximation approximation = Approximation::mls;
  InternalForce internal_force = InternalForce::galerkin;
  double isobaric_scale = 0.1;  // delta of PC (15): relative difference of pressures that counts as large
  ViscousForce viscous_force = ViscousForce::stress;
  Integrator integrator = Integrator::kick_drift_kick;
  double multistep_beta1 = 1, multistep_beta2 = 1;  // of PC (26)-(27)
  Quadrature quadrature = Quadrature::nodal;
  Mass mass = Mass::physical;
  BoundaryTreatment boundary = BoundaryTreatment::layers;
  double boundary_pressure = 0;            // sets A of CF (113) [Pa]; 0: rho0/2 (c0/10)^2
  bool force_on_receding = false;          // boundary forces without f1 of CF (112)
  double interpolated_motion = 0;          // share of v-hat CF (75) in the velocity that moves the particles
  bool initial_parameters = false;         // the velocities given are those of the fluid, CF (99)
  double smoothing = stable_smoothing(2);  // h/dx
  double density_diffusion = 0.1;          // delta
  double artificial_viscosity = 0.02;      // alpha
  double shifting = 0;                     // S of shifting.hpp; 0: none
  double spreading = 0;                    // S of crowding.hpp; 0: none
  bool tension_control = false;            // see tension_control.hpp
  double moment_floor = 0.2;               // smallest eigenvalue of C over the lattice's
  double courant = 0.4;                    // dt (c0 + v_max) / h
};

// Fluid particles at the start, all of one volume. Mass is volume times the density that belongs to the
// pressure: particles of one mass on a lattice would not be at rest, since their volumes would not fill it.
struct FluidParticles {
  std::vector<Eigen::Vector3d> position;  // [m]
  std::vector<Eigen::Vector3d> velocity;  // [m/s]
  std::vector<double> pressure;           // [Pa]; sets the density by the equation of state, CF (64)
  double volume = 0;                      // [m^3], [m^2] in 2D
  std::vector<std::uint8_t> liquid = {};  // number in Setup::liquids; empty where those are
};

// Boundary particles of one body, or of the walls, in the body's frame. A particle of a thin plate belongs to
// one of its faces and acts only on fluid in front of that, outward of the plane through its point. A body
// may consist of several plates, and of other parts.
struct Boundary {
  std::vector<Eigen::Vector3d> position;    // [m]
  std::vector<double> volume;               // [m^3], [m^2] in 2D
  std::vector<Eigen::Vector3d> to_surface;  // from the particle to the nearest point of the surface [m]
  std::vector<Eigen::Vector3d> velocity;  // of a wall along itself [m/s]; empty: none. Bodies have kinematics
  bool no_slip = false;                   // a viscous fluid has the surface's velocity there; else it slides
  double free_mass = 0;  // of a body that answers to the fluid's force [kg], [kg/m] in 2D; 0: prescribed
  struct Face {
    Eigen::Vector3d point, normal;
    bool is_covered = false;  // by other parts of the body: no fluid is in front of it
  };
  std::vector<std::vector<Face>> plates;  // the faces of each; empty: an ordinary body, seen from everywhere
  // Per particle: index into plates and into that plate's faces, -1 of other parts; empty when plates is.
  std::vector<std::int32_t> plate, face;
};

// Sides that are one and the same: what leaves through one comes in through the other. No boundary particle
// of a body may come near them.
struct Period {
  Eigen::Vector3d lower = Eigen::Vector3d::Zero();   // lower corner of the period [m]
  Eigen::Vector3d length = Eigen::Vector3d::Zero();  // per axis [m]; 0: not periodic
};

// Sides in which the fluid sees its own mirror image instead of boundary particles: plane walls at rest,
// along which the fluid slides and gravity pulls. Of axis a they are number 2 a (lower) and 2 a + 1 (upper).
struct Mirrors {
  Eigen::Vector3d lower = Eigen::Vector3d::Zero(), upper = Eigen::Vector3d::Zero();  // [m]
  std::array<bool, 6> at{};
};

// A rectangle in a side of the tank through which liquid comes in or leaves (openings.hpp). What is not given
// there is taken over from the flow.
struct Opening {
  int side = 0;                                   // of axis a number 2 a (lower) and 2 a + 1 (upper)
  Eigen::Vector3d min = Eigen::Vector3d::Zero();  // its corners [m], in the plane of the side
  Eigen::Vector3d max = Eigen::Vector3d::Zero();
  bool inflow = true;  // else what leaves does not come back
  // Of time [s] and place. Into the tank [m/s], at an inflow; the pressure [Pa].
  std::function<double(double, const Eigen::Vector3d&)> speed, pressure;
  // Of time [s]: where the liquid's surface stands, measured against gravity from the origin [m]. Sets a
  // hydrostatic pressure, and an inflow is dry above.
  std::function<double(double)> level;
};

struct Setup {
  int dimension = 2;
  double spacing = 0;  // dx [m]
  Eigen::Vector3d gravity{0, 0, 0};
  Period period;
  Mirrors mirrors;
  Liquid liquid;  // of several the heaviest
  // Where there are several, all of them, equally stiff: density * sound_speed^2 is the same.
  std::vector<Liquid> liquids;
  Formulation formulation;
  FluidParticles fluid;
  Boundary walls;                   // at rest, world frame
  bool measure_wall_force = false;  // the walls' wrench costs a sweep over wall particles near the fluid
  std::vector<Boundary> bodies;
  std::vector<Opening> openings;
  bool limit_step_by_bodies = true;  // see body_step.hpp; not where the exchange with them is iterated
  int threads = 1;

  [[nodiscard]] bool has_viscous_stress() const {
    return (liquid.viscosity > 0.0 ||
            std::any_of(liquids.begin(), liquids.end(), [](const Liquid& l) { return l.viscosity > 0.0; })) &&
           formulation.viscous_force == ViscousForce::stress;
  }
};

}  // namespace sluice::fluid
