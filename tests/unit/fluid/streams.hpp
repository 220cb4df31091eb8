#pragma once

#include "tests/unit/fluid/setups.hpp"

namespace sluice::fluid {

// A channel from an inflow at its lower end along x to an outflow at its upper end, both over the whole cross
// section. Lengths in m, up is y in the plane and z in space.
struct Stream : Scene {
  static constexpr double kSpacing = 0.1, kSpeed = 1.0, kSound = 10.0;

  // Full of liquid that moves with kSpeed, without gravity.
  static Stream closed(int dimension, const Eigen::Vector3d& size) {
    Stream stream(dimension, 0.0, kSound, size);
    stream.inflow().speed = [](double, const Eigen::Vector3d&) { return kSpeed; };
    stream.outflow().pressure = [](double, const Eigen::Vector3d&) { return 0.0; };
    stream.close();
    stream.add_block({0, 0, 0}, size, {kSpeed, 0, 0});
    return stream;
  }

  // Open at the top, with liquid up to `depth` that moves with `speed`. The caller sets what is given at the
  // openings, then calls close().
  static Stream open(int dimension, const Eigen::Vector3d& size, double depth, double speed) {
    Stream stream(dimension, 9.81, kSound * (speed + std::sqrt(9.81 * depth)), size);
    Eigen::Vector3d top = size;
    top[dimension - 1] = depth;
    stream.add_still_water({0, 0, 0}, top);
    for (Eigen::Vector3d& v : stream.setup.fluid.velocity) v.x() = speed;
    stream.is_closed_[2 * static_cast<std::size_t>(dimension) - 1] = false;
    return stream;
  }

  Opening& inflow() { return setup.openings[0]; }
  Opening& outflow() { return setup.openings[1]; }

  void close() {
    Tank tank{Eigen::Vector3d::Zero(), size_, is_closed_};
    tank.openings = setup.openings;
    setup.walls = sample_walls(tank, setup.spacing, support(), setup.dimension);
  }

 private:
  Stream(int dimension, double gravity, double sound, const Eigen::Vector3d& size)
      : Scene(dimension, kSpacing, gravity, sound), size_(size) {
    Eigen::Vector3d near = size, far = Eigen::Vector3d::Zero();
    near.x() = 0;
    far.x() = size.x();
    setup.openings.resize(2);
    inflow().max = near;
    outflow() = {
        .side = 1, .min = far, .max = size, .inflow = false, .speed = {}, .pressure = {}, .level = {}};
  }

  Eigen::Vector3d size_;
  std::array<bool, 6> is_closed_{true, true, true, true, true, true};
};

}  // namespace sluice::fluid
