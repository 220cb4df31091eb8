#include <algorithm>
#include <limits>

#include "fluid/layers.hpp"
#include "fluid/plate_sampling.hpp"
#include "fluid/sampling.hpp"

namespace sluice::fluid {

namespace {

class Assembly {
 public:
  Assembly(const CompoundShape& compound, double spacing, double support, int dimension)
      : compound_(compound), spacing_(spacing), support_(support), dimension_(dimension) {}

  Boundary run() {
    for (std::size_t p = 0; p < compound_.parts.size(); ++p) {
      const PlacedShape& part = compound_.parts[p];
      if (needs_plate_rule(part.shape, support_, dimension_)) {
        plates_.push_back({p, {}});
        for (const FlatFace& face : flat_faces(part.shape, dimension_))
          plates_.back().faces.push_back(face.in(part));
      } else {
        thick_.push_back({p, placed(sample_thick(part.shape, spacing_, support_, dimension_), part), {}});
      }
    }
    for (ThickPart& part : thick_) find_exposed(part);
    for (const ThickPart& part : thick_) take(part);
    if (!plates_.empty()) append_plates();
    return std::move(body_);
  }

 private:
  struct ThickPart {
    std::size_t part;  // number in the compound
    Boundary sampled;
    std::vector<bool> is_exposed;  // the surface in front of the particle
  };

  // Whether x is in another part than p or on its surface; within `margin` [m].
  [[nodiscard]] bool is_covered(const Eigen::Vector3d& x, std::size_t p, double margin) const {
    for (std::size_t other = 0; other < compound_.parts.size(); ++other)
      if (other != p && distance(x, other) < margin) return true;
    return false;
  }
  [[nodiscard]] double distance(const Eigen::Vector3d& x, std::size_t p) const {
    const PlacedShape& part = compound_.parts[p];
    return signed_distance(part.shape, part.to_local(x), dimension_);
  }

  void find_exposed(ThickPart& part) {
    const Boundary& own = part.sampled;
    for (std::size_t k = 0; k < own.position.size(); ++k) {
      const Eigen::Vector3d surface = own.position[k] + own.to_surface[k];
      part.is_exposed.push_back(!is_covered(surface, part.part, margin()));
      if (part.is_exposed.back() && own.to_surface[k].norm() < spacing_) exposed_.push_back(surface);
    }
  }

  void take(const ThickPart& part) {
    const Boundary& own = part.sampled;
    for (std::size_t k = 0; k < own.position.size(); ++k) {
      const Eigen::Vector3d& x = own.position[k];
      if (is_covered(x, part.part, -margin())) continue;
      const Eigen::Vector3d way = part.is_exposed[k] ? own.to_surface[k] : to_exposed(x);
      if (way.norm() > support_) continue;
      body_.position.push_back(x);
      body_.volume.push_back(own.volume[k]);
      body_.to_surface.push_back(way);
    }
  }

  void append_plates() {
    body_.plate.assign(body_.position.size(), -1);
    body_.face = body_.plate;
    const auto covered = [this](const Eigen::Vector3d& x, std::size_t p) {
      return is_covered(x, p, margin());
    };
    const auto inside_thick = [this](const Eigen::Vector3d& x, std::size_t) {
      return std::any_of(thick_.begin(), thick_.end(),
                         [&](const ThickPart& part) { return distance(x, part.part) < -margin(); });
    };
    const PlateSeams seams{plates_, covered, inside_thick, spacing_, layer_count(support_, spacing_)};
    for (std::size_t p = 0; p < plates_.size(); ++p) seams.append(p, body_);
  }

  [[nodiscard]] double margin() const { return 1e-6 * spacing_; }

  [[nodiscard]] Eigen::Vector3d to_exposed(const Eigen::Vector3d& x) const {
    Eigen::Vector3d way = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
    for (const Eigen::Vector3d& surface : exposed_)
      if ((surface - x).squaredNorm() < way.squaredNorm()) way = surface - x;
    return way;
  }

  const CompoundShape& compound_;
  double spacing_, support_;
  int dimension_;
  std::vector<ThickPart> thick_;
  std::vector<PlatePart> plates_;
  std::vector<Eigen::Vector3d> exposed_;  // points of thick parts' surface, one a particle of the first layer
  Boundary body_;
};

}  // namespace

Boundary placed(Boundary boundary, const PlacedShape& place) {
  const Eigen::Matrix3d R = place.orientation.toRotationMatrix();
  for (Eigen::Vector3d& x : boundary.position) x = place.position + R * x;
  for (Eigen::Vector3d& way : boundary.to_surface) way = R * way;
  for (std::vector<Boundary::Face>& faces : boundary.plates)
    for (Boundary::Face& face : faces)
      face = {place.position + R * face.point, R * face.normal, face.is_covered};
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
