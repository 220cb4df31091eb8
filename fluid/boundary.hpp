#pragma once

#include <span>
#include <tuple>
#include <vector>

#include "fluid/kinematics.hpp"
#include "fluid/particles.hpp"
#include "fluid/setup.hpp"

namespace sluice::fluid {

// A plane; in front of it where normal . x > offset.
template <int Dim>
struct Plane {
  Vec<Dim> normal;
  double offset;
  [[nodiscard]] double distance(const Vec<Dim>& x) const { return normal.dot(x) - offset; }
};

// A body, or a part of one, whose sides must not see each other, in its present pose: the intersection of the
// half-spaces behind its faces.
template <int Dim>
struct Plate {
  std::int32_t body;
  std::vector<Plane<Dim>> faces;
  std::vector<bool> is_covered;  // per face, by other parts of the body

  auto state() { return std::tie(faces); }
};

// The surface as a boundary particle behind it sees it.
template <int Dim>
struct Surface {
  Vec<Dim> normal = Vec<Dim>::Zero();  // into the fluid
  double depth = 0;                    // of the particle below it [m]
  // Projects on the normals of the faces there: one, or several behind an edge of the tank.
  Mat<Dim> across = Mat<Dim>::Zero();
};

// What the fluid i near a boundary particle gets from it besides its pressure, W (s + S x_iw), and the sum of
// that over i: returned_force.hpp.
template <int Dim>
struct ReturnedForce {
  Vec<Dim> s = Vec<Dim>::Zero();                     // [N m^Dim]
  Mat<Dim> S = Mat<Dim>::Zero();                     // [N m^(Dim-1)]
  Vec<Dim> force = Vec<Dim>::Zero();                 // [N]
  Eigen::Vector3d couple = Eigen::Vector3d::Zero();  // about the boundary particle [N m]
};

// All boundary particles: the walls first, then body after body. Walls are body 0, at rest; the scene's body
// b is body b + 1 here; the images of bodies are bodies too.
template <int Dim>
class BoundaryParticles {
 public:
  explicit BoundaryParticles(const Setup& setup) : BoundaryParticles(setup, setup.bodies) {}
  // With these in the place of the setup's bodies.
  BoundaryParticles(const Setup& setup, std::span<const Boundary> bodies);

  // Moves the particles of the bodies to the end of the step; those of a body that moves no further stay as
  // they are.
  void move(std::span<const Kinematics> bodies);

  [[nodiscard]] std::size_t size() const { return node_.size(); }
  [[nodiscard]] std::vector<Node<Dim>>& node() { return node_; }
  [[nodiscard]] const std::vector<Node<Dim>>& node() const { return node_; }
  // Of the body there; node().v is that of the fluid that the particle stands in for.
  [[nodiscard]] const Vec<Dim>& velocity(std::size_t w) const { return velocity_[w]; }
  [[nodiscard]] const Vec<Dim>& acceleration(std::size_t w) const { return acceleration_[w]; }
  // The surface as the particle sees it.
  [[nodiscard]] const Surface<Dim>& surface(std::size_t w) const { return surface_[w]; }
  [[nodiscard]] bool no_slip(std::size_t w) const { return no_slip_[static_cast<std::size_t>(body_[w])]; }
  [[nodiscard]] bool sticks() const { return !sticking.empty(); }
  [[nodiscard]] std::int32_t body(std::size_t w) const { return body_[w]; }
  // Index into plates()[plate(w)].faces of a plate's particle; plate(w) is -1 for all others.
  [[nodiscard]] std::int32_t face(std::size_t w) const { return face_[w]; }
  [[nodiscard]] std::int32_t plate(std::size_t w) const { return plate_[w]; }
  [[nodiscard]] const std::vector<Plate<Dim>>& plates() const { return plates_; }
  [[nodiscard]] std::size_t body_count() const { return no_slip_.size(); }

  // From now on these return forces, zero to begin with, and no others.
  void make_returning(std::span<const std::size_t> particles);
  // Null of most.
  [[nodiscard]] const ReturnedForce<Dim>* returned(std::size_t w) const {
    return returned_at_[w] < 0 ? nullptr : &returned_force[static_cast<std::size_t>(returned_at_[w])];
  }

  // Volume as sampled [m^Dim], 0 with boundary forces; node().volume follows the compression of the fluid
  // near it.
  [[nodiscard]] double sampled_volume(std::size_t w) const { return sampled_volume_[w]; }

  // Extrapolated from the fluid every step.
  std::vector<double> pressure;  // [Pa]
  std::vector<Mat<Dim>> stress;  // viscous part [Pa]; empty without viscosity
  std::vector<double> dilation;  // wetness times volume of the fluid near over its first volume
  std::vector<double> impact;    // share in an impact (0 to 1)
  // |g| of the fluid near over the lattice's G h: 0 where it is all around, as on a lattice.
  std::vector<double> one_sided;
  // Of the boundary particles that return a force, in the order of make_returning.
  std::vector<ReturnedForce<Dim>> returned_force;
  // What a no-slip surface adds to node().v in the shear of a viscous fluid [m/s]; empty without.
  std::vector<Vec<Dim>> sticking;
  // Share of the flow's mean across the surface that node().v has reversed: boundary_velocity.hpp.
  std::vector<double> reversal;

  // What moves and what is extrapolated; the rest stays as it was sampled.
  auto state() {
    return std::tie(node_, velocity_, acceleration_, surface_, plates_, moved_to_, pressure, stress, dilation,
                    one_sided, sticking);
  }

 private:
  void append(const Boundary& boundary, const Setup& setup);
  void append_surface(const Eigen::Vector3d& to_surface, bool is_wall);
  void move_body(std::size_t body, const Kinematics& kinematics);
  void append_plates(const Boundary& boundary, std::int32_t body);
  void move_plate(const Kinematics& kinematics, std::size_t plate);

  std::vector<Node<Dim>> node_;
  std::vector<Vec<Dim>> local_, local_normal_;
  std::vector<Vec<Dim>> velocity_, acceleration_;
  std::vector<Kinematics> moved_to_;  // of every body, what its particles were moved by; empty at first
  std::vector<Surface<Dim>> surface_;
  std::vector<bool> no_slip_;  // per body
  std::vector<double> sampled_volume_;
  std::vector<std::int32_t> body_, plate_, face_;
  std::vector<std::int32_t> returned_at_;  // place in returned_force, or -1
  std::vector<std::size_t> first_;         // of every body, and the end
  std::vector<Plate<Dim>> plates_;
  std::vector<std::vector<Boundary::Face>> local_faces_;  // per plate
};

extern template class BoundaryParticles<2>;
extern template class BoundaryParticles<3>;

}  // namespace sluice::fluid
