#include <limits>

#include "fluid/layers.hpp"

namespace sluice::fluid {

namespace {

class Assembly {
 public:
  Assembly(const CompoundShape& compound, double spacing, double support, int dimension)
      : compound_(compound), spacing_(spacing), support_(support), dimension_(dimension) {}

  Boundary run() {
    for (const PlacedShape& part : compound_.parts)
      sampled_.push_back(placed(sample_thick(part.shape, spacing_, support_, dimension_), part));
    for (std::size_t p = 0; p < sampled_.size(); ++p) find_exposed(p);
    for (std::size_t p = 0; p < sampled_.size(); ++p) take(p);
    return std::move(body_);
  }

 private:
  // Whether x is in another part than p or on its surface; within `margin` [m].
  [[nodiscard]] bool is_covered(const Eigen::Vector3d& x, std::size_t p, double margin) const {
    for (std::size_t other = 0; other < compound_.parts.size(); ++other) {
      const PlacedShape& part = compound_.parts[other];
      if (other != p && signed_distance(part.shape, part.to_local(x), dimension_) < margin) return true;
    }
    return false;
  }

  void find_exposed(std::size_t p) {
    const Boundary& own = sampled_[p];
    is_exposed_.emplace_back();
    for (std::size_t k = 0; k < own.position.size(); ++k) {
      const Eigen::Vector3d surface = own.position[k] + own.to_surface[k];
      is_exposed_[p].push_back(!is_covered(surface, p, 1e-6 * spacing_));
      if (is_exposed_[p].back() && own.to_surface[k].norm() < spacing_) exposed_.push_back(surface);
    }
  }

  void take(std::size_t p) {
    const Boundary& own = sampled_[p];
    for (std::size_t k = 0; k < own.position.size(); ++k) {
      const Eigen::Vector3d& x = own.position[k];
      if (is_covered(x, p, -1e-6 * spacing_)) continue;
      const Eigen::Vector3d way = is_exposed_[p][k] ? own.to_surface[k] : to_exposed(x);
      if (way.norm() > support_) continue;
      body_.position.push_back(x);
      body_.volume.push_back(own.volume[k]);
      body_.to_surface.push_back(way);
    }
  }

  [[nodiscard]] Eigen::Vector3d to_exposed(const Eigen::Vector3d& x) const {
    Eigen::Vector3d way = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
    for (const Eigen::Vector3d& surface : exposed_)
      if ((surface - x).squaredNorm() < way.squaredNorm()) way = surface - x;
    return way;
  }

  const CompoundShape& compound_;
  double spacing_, support_;
  int dimension_;
  std::vector<Boundary> sampled_;
  std::vector<std::vector<bool>> is_exposed_;
  std::vector<Eigen::Vector3d> exposed_;  // points of the surface, one a particle of the first layer
  Boundary body_;
};

}  // namespace

Boundary placed(Boundary boundary, const PlacedShape& place) {
  const Eigen::Matrix3d R = place.orientation.toRotationMatrix();
  for (Eigen::Vector3d& x : boundary.position) x = place.position + R * x;
  for (Eigen::Vector3d& way : boundary.to_surface) way = R * way;
  for (Boundary::Face& face : boundary.faces) face = {place.position + R * face.point, R * face.normal};
  return boundary;
}

Boundary sample_compound(const CompoundShape& compound, double spacing, double support, int dimension) {
  if (compound.parts.size() == 1) {
    const PlacedShape& only = compound.parts.front();
    return placed(sample_body(only.shape, spacing, support, dimension), only);
  }
  return Assembly(compound, spacing, support, dimension).run();
}

}  // namespace sluice::fluid
