#pragma once

#include <Eigen/Core>
#include <vector>

#include "fluid/kinematics.hpp"
#include "fluid/setup.hpp"
#include "protocol/mass_properties.hpp"

namespace sluice::server {

// How the wet part of a body's surface resists its motion by the sound that it radiates: a patch dA with the
// normal n answers its velocity u with the force  -rho0 c0 (n.u) n dA,  the whole surface a twist w with  -Z
// w,
//   Z = rho0 c0 sum_patches [n; x cross n] [n; x cross n]^T dA.
class WetSurface {
 public:
  struct Medium {
    int dimension;
    double spacing;    // [m]
    double impedance;  // rho0 c0 [kg/(m^2 s)]
  };
  struct Inertia {
    protocol::MassProperties properties;
    Eigen::Vector3d free, free_rotation;  // 1 along and about axes that are free, 0 otherwise
  };
  WetSurface(const fluid::Boundary& body, const Inertia& inertia, const Medium& medium);

  // The largest eigenvalue of M^-1 Z [1/s], M mass and inertia: of all the surface; of what liquid touches.
  [[nodiscard]] double whole_rate() const;
  [[nodiscard]] double rate(const std::vector<double>& liquid, const fluid::Kinematics& body);

 private:
  using Twist = Eigen::Matrix<double, 6, 1>;
  struct Patch {
    Eigen::Vector3d before;  // a place one spacing before it, in the body's frame [m]
    Twist direction;         // of its force, over the roots of mass and inertia
    double impedance;        // rho0 c0 dA [kg/s]
  };
  using Matrix = Eigen::Matrix<double, 6, 6>;

  void mark(const std::vector<double>& liquid, const fluid::Kinematics& body);
  [[nodiscard]] bool is_wet(const Patch& patch) const;
  [[nodiscard]] Eigen::Vector3i cell_of(const Eigen::Vector3d& x) const;
  [[nodiscard]] std::size_t index(const Eigen::Vector3i& cell) const;

  int dimension_;
  double spacing_;
  std::vector<Patch> patches_;
  // Cells of one spacing around the body that hold liquid, in the body's frame.
  Eigen::Vector3d low_, high_;
  Eigen::Vector3i cells_;
  std::vector<char> occupied_;
};

}  // namespace sluice::server
