#pragma once

#include <array>

#include "fluid/equation_of_state.hpp"
#include "fluid/sampling.hpp"
#include "fluid/solver.hpp"

namespace sluice::fluid {

// Setups of water, up being y in the plane and z in space. Lengths in m.
struct Scene {
  Scene(int dimension, double spacing, double gravity, double sound_speed) {
    setup.dimension = dimension;
    setup.spacing = spacing;
    setup.formulation.smoothing = stable_smoothing(dimension);
    setup.gravity[dimension - 1] = -gravity;
    setup.liquid = {1000, 0, sound_speed};
    setup.fluid.volume = particle_volume(spacing, dimension);
  }

  [[nodiscard]] double support() const { return 2.0 * setup.formulation.smoothing * setup.spacing; }

  // Water at zero pressure with one velocity.
  void add_block(const Eigen::Vector3d& min, const Eigen::Vector3d& max, const Eigen::Vector3d& velocity) {
    for (const Eigen::Vector3d& x : lattice(min, max)) add_particle(x, velocity, 0.0);
  }

  // Water at rest with a free surface at the upper side of the box.
  void add_still_water(const Eigen::Vector3d& min, const Eigen::Vector3d& max) {
    const EquationOfState eos(setup.liquid.density, setup.liquid.sound_speed);
    const int up = setup.dimension - 1;
    for (const Eigen::Vector3d& x : lattice(min, max)) {
      const double head = -setup.gravity[up] * (max[up] - x[up]);
      add_particle(x, Eigen::Vector3d::Zero(), eos.pressure(eos.hydrostatic_density(head)));
    }
  }

  // Walls on all sides but the upper one.
  void add_tank(const Eigen::Vector3d& min, const Eigen::Vector3d& max) {
    std::array<bool, 6> closed{true, true, true, true, true, true};
    closed[2 * static_cast<std::size_t>(setup.dimension) - 1] = false;
    const Tank tank{min, max, closed};
    setup.walls = has_forces() ? sample_wall_surface(tank, setup.spacing, support() / 2, setup.dimension)
                               : sample_walls(tank, setup.spacing, support(), setup.dimension);
  }

  void add_body(const Shape& shape) {
    setup.bodies.push_back(has_forces() ? sample_body_surface(shape, setup.spacing, setup.dimension)
                                        : sample_body(shape, setup.spacing, support(), setup.dimension));
  }

  void add_particle(const Eigen::Vector3d& x, const Eigen::Vector3d& v, double pressure) {
    setup.fluid.position.push_back(x);
    setup.fluid.velocity.push_back(v);
    setup.fluid.pressure.push_back(pressure);
  }

  // Masses in the order of the setup [kg].
  [[nodiscard]] std::vector<double> masses() const {
    const EquationOfState eos(setup.liquid.density, setup.liquid.sound_speed);
    std::vector<double> m;
    for (const double p : setup.fluid.pressure) m.push_back(eos.density(p) * setup.fluid.volume);
    return m;
  }

  Setup setup;

 private:
  [[nodiscard]] bool has_forces() const { return setup.formulation.boundary == BoundaryTreatment::forces; }
  [[nodiscard]] std::vector<Eigen::Vector3d> lattice(const Eigen::Vector3d& min,
                                                     const Eigen::Vector3d& max) const {
    return fill(BoxShape{(max - min) / 2}, (min + max) / 2, setup.spacing, setup.dimension);
  }
};

}  // namespace sluice::fluid
