#include "fluid/body_images.hpp"

namespace sluice::fluid {

// Axis by axis, reflections of reflections included, which fills the edges and corners.
BodyImages::BodyImages(const Setup& setup) {
  const Mirrors& mirrors = setup.mirrors;
  std::vector<Reflection> all{{Eigen::Vector3d::Ones(), Eigen::Vector3d::Zero()}};
  for (int a = 0; a < setup.dimension; ++a) {
    const std::size_t before = all.size();
    for (const bool upper : {false, true}) {
      if (!mirrors.at[2 * static_cast<std::size_t>(a) + (upper ? 1 : 0)]) continue;
      for (std::size_t k = 0; k < before; ++k) {
        Reflection reflection = all[k];
        reflection.flip[a] = -1.0;
        reflection.shift[a] = 2.0 * (upper ? mirrors.upper : mirrors.lower)[a];
        all.push_back(reflection);
      }
    }
  }
  reflections_.assign(all.begin() + 1, all.end());
}

Boundary BodyImages::Reflection::of(const Boundary& body) const {
  Boundary image = body;
  for (Eigen::Vector3d& x : image.position) x = flip.cwiseProduct(x);
  for (Eigen::Vector3d& x : image.to_surface) x = flip.cwiseProduct(x);
  for (std::vector<Boundary::Face>& faces : image.plates)
    for (Boundary::Face& face : faces)
      face = {flip.cwiseProduct(face.point), flip.cwiseProduct(face.normal), face.is_covered};
  return image;
}

// A rotation R is F R F in the mirror, F = diag(flip); rotation vectors change sign besides where F is a
// reflection and not a rotation.
Kinematics BodyImages::Reflection::of(const Kinematics& motion) const {
  const Eigen::Vector3d turn = flip.prod() * flip;
  Kinematics image;
  image.position = flip.cwiseProduct(motion.position) + shift;
  image.orientation.w() = motion.orientation.w();
  image.orientation.vec() = turn.cwiseProduct(motion.orientation.vec());
  image.velocity = flip.cwiseProduct(motion.velocity);
  image.acceleration = flip.cwiseProduct(motion.acceleration);
  image.angular_velocity = turn.cwiseProduct(motion.angular_velocity);
  image.angular_acceleration = turn.cwiseProduct(motion.angular_acceleration);
  return image;
}

std::vector<Boundary> BodyImages::with_images(const std::vector<Boundary>& bodies) const {
  std::vector<Boundary> all = bodies;
  for (const Reflection& reflection : reflections_)
    for (const Boundary& body : bodies) all.push_back(reflection.of(body));
  return all;
}

std::span<const Kinematics> BodyImages::with_images(std::span<const Kinematics> bodies) {
  if (reflections_.empty()) return bodies;
  motions_.assign(bodies.begin(), bodies.end());
  for (const Reflection& reflection : reflections_)
    for (const Kinematics& motion : bodies) motions_.push_back(reflection.of(motion));
  return motions_;
}

}  // namespace sluice::fluid
