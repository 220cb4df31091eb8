#include "fluid/boundary.hpp"

#include <algorithm>
#include <cassert>

#include "fluid/boundary_order.hpp"
#include "fluid/group_list.hpp"

namespace sluice::fluid {

template <int Dim>
BoundaryParticles<Dim>::BoundaryParticles(const Setup& setup, std::span<const Boundary> bodies) {
  const double cell = group_edge<Dim>(setup.spacing);
  const Boundary walls = in_rows<Dim>(setup.walls, cell);
  append(walls, setup);
  for (const Boundary& body : bodies) append(in_rows<Dim>(body, cell), setup);
  first_.push_back(node_.size());
  velocity_.assign(size(), Vec<Dim>::Zero());
  for (std::size_t w = 0; w < walls.velocity.size(); ++w) velocity_[w] = narrow<Dim>(walls.velocity[w]);
  acceleration_.assign(size(), Vec<Dim>::Zero());
  pressure.assign(size(), 0.0);
  dilation.assign(size(), 1.0);
  impact.assign(size(), 0.0);
  one_sided.assign(size(), 0.0);
  reversal.assign(size(), 0.0);
  returned_at_.assign(size(), -1);
  if (!setup.has_viscous_stress()) return;
  stress.assign(size(), Mat<Dim>::Zero());
  if (std::find(no_slip_.begin(), no_slip_.end(), true) != no_slip_.end())
    sticking.assign(size(), Vec<Dim>::Zero());
}

template <int Dim>
void BoundaryParticles<Dim>::make_returning(std::span<const std::size_t> particles) {
  if (!returned_force.empty()) std::fill(returned_at_.begin(), returned_at_.end(), -1);
  returned_force.assign(particles.size(), {});
  for (std::size_t k = 0; k < particles.size(); ++k)
    returned_at_[particles[k]] = static_cast<std::int32_t>(k);
}

template <int Dim>
void BoundaryParticles<Dim>::append(const Boundary& boundary, const Setup& setup) {
  const auto body = static_cast<std::int32_t>(body_count());
  const auto first_plate = static_cast<std::int32_t>(plates_.size());
  const bool has_volume = setup.formulation.boundary == BoundaryTreatment::layers;
  first_.push_back(node_.size());
  no_slip_.push_back(boundary.no_slip);
  assert(boundary.to_surface.size() == boundary.position.size());
  for (std::size_t k = 0; k < boundary.position.size(); ++k) {
    const Vec<Dim> x = narrow<Dim>(boundary.position[k]);
    const double volume = has_volume ? boundary.volume[k] : 0.0;
    node_.push_back({x, Vec<Dim>::Zero(), volume, setup.liquid.density});
    local_.push_back(x);
    append_surface(boundary.to_surface[k], body == 0);
    sampled_volume_.push_back(volume);
    body_.push_back(body);
    const bool is_plates = !boundary.plates.empty() && boundary.plate[k] >= 0;
    plate_.push_back(is_plates ? first_plate + boundary.plate[k] : -1);
    face_.push_back(is_plates ? boundary.face[k] : -1);
  }
  append_plates(boundary, body);
}

template <int Dim>
void BoundaryParticles<Dim>::append_plates(const Boundary& boundary, std::int32_t body) {
  for (const std::vector<Boundary::Face>& faces : boundary.plates) {
    Plate<Dim> plate{body, {}, {}};
    for (const Boundary::Face& face : faces) {
      const Vec<Dim> normal = narrow<Dim>(face.normal);
      plate.faces.push_back({normal, normal.dot(narrow<Dim>(face.point))});
      plate.is_covered.push_back(face.is_covered);
    }
    plates_.push_back(plate);
    local_faces_.push_back(faces);
  }
}

// The tank is axis-parallel: where the way to its surface has several components, there are several faces.
template <int Dim>
void BoundaryParticles<Dim>::append_surface(const Eigen::Vector3d& to_surface, bool is_wall) {
  const Vec<Dim> way = narrow<Dim>(to_surface);
  Surface<Dim> surface{way.normalized(), way.norm(), Mat<Dim>::Zero()};
  if (is_wall) {
    for (int a = 0; a < Dim; ++a) surface.across(a, a) = way[a] != 0.0 ? 1.0 : 0.0;
  } else {
    surface.across = surface.normal * surface.normal.transpose();
  }
  local_normal_.push_back(surface.normal);
  surface_.push_back(surface);
}

template <int Dim>
void BoundaryParticles<Dim>::move(std::span<const Kinematics> bodies) {
  assert(bodies.size() + 1 == body_count());
  for (std::size_t b = 0; b < bodies.size(); ++b)
    if (moved_to_.empty() || !(moved_to_[b] == bodies[b])) move_body(b + 1, bodies[b]);
  moved_to_.assign(bodies.begin(), bodies.end());
}

// x = X + R x_local;  v = U + Omega x r;  a = A + dOmega/dt x r + Omega x (Omega x r)
template <int Dim>
void BoundaryParticles<Dim>::move_body(std::size_t body, const Kinematics& k) {
  const Eigen::Matrix3d R = k.orientation.toRotationMatrix();
  for (std::size_t w = first_[body]; w < first_[body + 1]; ++w) {
    const Eigen::Vector3d r = R * widen<Dim>(local_[w]);
    node_[w].x = narrow<Dim>(k.position + r);
    velocity_[w] = narrow<Dim>(k.velocity + k.angular_velocity.cross(r));
    acceleration_[w] = narrow<Dim>(k.acceleration + k.angular_acceleration.cross(r) +
                                   k.angular_velocity.cross(k.angular_velocity.cross(r)));
    surface_[w].normal = narrow<Dim>(R * widen<Dim>(local_normal_[w]));
    surface_[w].across = surface_[w].normal * surface_[w].normal.transpose();
  }
  for (std::size_t p = 0; p < plates_.size(); ++p)
    if (plates_[p].body == static_cast<std::int32_t>(body)) move_plate(k, p);
}

template <int Dim>
void BoundaryParticles<Dim>::move_plate(const Kinematics& k, std::size_t plate) {
  const Eigen::Matrix3d R = k.orientation.toRotationMatrix();
  const std::vector<Boundary::Face>& faces = local_faces_[plate];
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const Eigen::Vector3d normal = R * faces[f].normal;
    plates_[plate].faces[f] = {narrow<Dim>(normal), normal.dot(k.position + R * faces[f].point)};
  }
}

template class BoundaryParticles<2>;
template class BoundaryParticles<3>;

}  // namespace sluice::fluid
