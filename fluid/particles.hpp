#pragma once

#include <cstdint>
#include <tuple>
#include <vector>

#include "fluid/liquids.hpp"
#include "fluid/moments.hpp"
#include "fluid/types.hpp"

namespace sluice::fluid {

// What a neighbour loop reads of any particle, fluid or boundary; one cache line in two dimensions.
template <int Dim>
struct Node {
  Vec<Dim> x = Vec<Dim>::Zero();  // [m]
  Vec<Dim> v = Vec<Dim>::Zero();  // [m/s]
  double volume = 0;              // V = m/rho [m^Dim]
  double rho = 0;  // [kg/m^3]; of several liquids, that which the reference has at the same pressure
};

// What sweep 1 leaves for sweep 2 at a fluid particle k: its fit and its stress.
template <int Dim>
struct Source {
  Vec<Dim> s = Vec<Dim>::Zero();  // V sigma g
  Mat<Dim> S = Mat<Dim>::Zero();  // V sigma G
};

// And the linear flow around it, for what goes by that or by what it leaves. Halved, since a pair of
// particles goes by the mean of both.
template <int Dim>
struct FlowGradients {
  Vec<Dim> half_grad_rho = Vec<Dim>::Zero();  // [kg/m^4]
  Symmetric<Dim> half_strain;                 // of the symmetric part of the velocity gradient [1/s]
  // In the place of Source, where that is not in use: V sigma of a stress sigma I [Pa m^Dim].
  double V_sigma = 0;

  [[nodiscard]] Vec<Dim> grad_rho() const { return 2.0 * half_grad_rho; }
  [[nodiscard]] Mat<Dim> strain() const { return 2.0 * half_strain; }
  void set(const Vec<Dim>& grad_rho, const Mat<Dim>& strain) {
    half_grad_rho = 0.5 * grad_rho;
    half_strain = 0.5 * strain;
  }
};

// What MLS with the full derivative leaves in addition (approximation.hpp).
template <int Dim>
struct SlopeSource {
  Mat<Dim> sigma_V = Mat<Dim>::Zero();  // V sigma
  double a = 0;                         // N_j = V_j W (a + b.x_ji)
  Vec<Dim> b = Vec<Dim>::Zero();
};

// V_s sigma_s g_s and V_s sigma_s G_s of a stress point (approximation.hpp).
template <int Dim>
struct PointSource {
  Vec<Dim> s = Vec<Dim>::Zero();
  Mat<Dim> S = Mat<Dim>::Zero();
};

// What several liquids need in addition at a particle with another liquid in its support
// (liquid_interface.hpp): the fit of its own liquid, and the viscous stress with it as in Source.
template <int Dim>
struct OwnLiquid {
  bool is_at_interface = false;
  Fit<Dim> fit;
  Vec<Dim> s = Vec<Dim>::Zero();
  Mat<Dim> S = Mat<Dim>::Zero();
};

// The state of the fluid, in the order of the last sort. Arrays of size() particles; node, pressure, stress,
// fit, source, gradients, slope_source and point_source go on with the images beyond periodic and
// mirrored sides (halo.hpp), and so do liquid and own.
template <int Dim>
struct Particles {
  std::vector<double> mass;            // [kg]
  std::vector<Node<Dim>> node;         // position, velocity, volume, density
  std::vector<Vec<Dim>> acceleration;  // [m/s^2]
  std::vector<double> density_rate;    // by density diffusion [kg/(m^3 s)]
  std::vector<std::uint32_t> id;       // index in Setup::fluid; rising numbers for what came in later
  // Of the buffer behind an opening, its number + 1, else 0; empty without openings (openings.hpp).
  std::vector<std::uint8_t> opening;
  // Number in liquids; both are empty with one liquid.
  std::vector<std::uint8_t> liquid;
  std::vector<LiquidConstants> liquids;
  // Of the present step:
  std::vector<double> pressure;    // [Pa]
  std::vector<double> divergence;  // of the velocity [1/s]
  std::vector<Mat<Dim>> stress;    // sigma + p I, the viscous part [Pa]; empty without viscosity
  std::vector<Fit<Dim>> fit;
  // Empty where the stress is a pressure alone: FlowGradients::V_sigma.
  std::vector<Source<Dim>> source;
  std::vector<FlowGradients<Dim>> gradients;
  std::vector<SlopeSource<Dim>> slope_source;  // empty but with the full derivative
  // Of the stress points, 2^Dim for each particle; empty without them.
  static constexpr std::size_t kPoints = std::size_t{1} << Dim;
  std::vector<PointSource<Dim>> point_source;
  std::vector<OwnLiquid<Dim>> own;  // empty with one liquid

  [[nodiscard]] std::size_t size() const { return id.size(); }
  [[nodiscard]] bool has_several_liquids() const { return !liquids.empty(); }
  [[nodiscard]] const LiquidConstants& liquid_of(std::size_t i) const { return liquids[liquid[i]]; }
  [[nodiscard]] double relative_density(std::size_t i) const {
    return has_several_liquids() ? liquid_of(i).relative_density : 1.0;
  }
  [[nodiscard]] bool is_buffer(std::size_t i) const { return !opening.empty() && opening[i] != 0; }

  // What a run changes, here as in all that has it: state_bytes.hpp.
  auto state() {
    return std::tie(mass, node, acceleration, density_rate, id, opening, liquid, pressure, divergence, stress,
                    fit, source, gradients, slope_source, point_source, own);
  }
};

}  // namespace sluice::fluid
