#pragma once

#include <random>

#include "fluid/boundary.hpp"
#include "fluid/sampling.hpp"
#include "fluid/thin_plate.hpp"
#include "tests/unit/fluid/clouds.hpp"

namespace sluice::fluid {

// A thin box with layers of its own for every face, and its planes in any pose.
template <int Dim>
struct PlateCase {
  // Layers a spacing of 0.05 apart, 0.15 deep.
  explicit PlateCase(const Eigen::Vector3d& half_size)
      : shape{half_size}, boundary(setup(sample_body(shape, 0.05, 0.15, Dim))) {
    boundary.move({&pose, 1});
  }

  void move_to(const Kinematics& k) {
    pose = k;
    boundary.move({&pose, 1});
  }
  [[nodiscard]] const Plate<Dim>& plate() const { return boundary.plates().front(); }
  // Distance of a point of the world from the plate's surface, negative inside.
  [[nodiscard]] double distance(const Vec<Dim>& x) const {
    return signed_distance(Shape(shape), pose.orientation.conjugate() * (widen<Dim>(x) - pose.position), Dim);
  }

  static Setup setup(const Boundary& body) {
    Setup s;
    s.bodies.push_back(body);
    return s;
  }

  BoxShape shape;
  Kinematics pose;
  BoundaryParticles<Dim> boundary;
};

template <int Dim>
Kinematics random_pose(std::mt19937_64& random) {
  Kinematics k;
  k.position = 0.3 * widen<Dim>(random_vector<Dim>(random));
  const Eigen::Vector3d axis =
      Dim == 2 ? Eigen::Vector3d::UnitZ() : Eigen::Vector3d(random_direction<3>(random));
  k.orientation = Eigen::AngleAxisd(3.0 * random_vector<2>(random)[0], axis);
  return k;
}

// Index of the face whose outward normal in the body's frame is `normal`.
template <int Dim>
std::size_t face_with(const PlateCase<Dim>& plate_case, const Eigen::Vector3d& normal) {
  std::size_t face = 0;
  for (std::size_t f = 0; f < plate_case.plate().faces.size(); ++f)
    if ((plate_case.plate().faces[f].normal - narrow<Dim>(plate_case.pose.orientation * normal)).norm() <
        1e-9)
      face = f;
  return face;
}

}  // namespace sluice::fluid
