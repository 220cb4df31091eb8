#include "fluid/plate_sampling.hpp"

#include <array>
#include <optional>

#include "fluid/layers.hpp"
#include "fluid/sampling.hpp"

namespace sluice::fluid {

namespace {

using Place = std::array<int, 2>;  // of a foot on the lattice of its face

// Where a face runs against another plate's: a line in space, the corner in the plane.
struct Seam {
  Place step;  // to it, from the last foot before it
  Eigen::Vector3d corner;
  Eigen::Vector3d along, other_along;  // of the two faces, away from what fluid sees of them
  bool is_first;                       // of the two, to have what is on the line that halves the corner
};

class PlateLayers {
 public:
  PlateLayers(const PlateSeams& seams, std::size_t p, Boundary& body) : seams_(seams), p_(p), body_(body) {}

  void run() {
    std::vector<Boundary::Face> faces;
    for (std::size_t f = 0; f < own().faces.size(); ++f) faces.push_back(append_face(f));
    body_.plates.push_back(faces);
  }

 private:
  [[nodiscard]] const PlatePart& own() const { return seams_.plates[p_]; }
  [[nodiscard]] bool is_seen(const Feet& feet, int a, int b) const {
    return feet.has(a, b) && !seams_.is_covered(feet.at(a, b), own().part);
  }

  Boundary::Face append_face(std::size_t f) {
    const Feet feet(own().faces[f], seams_.spacing);
    bool is_covered = true;
    for (int b = 0; b < feet.n2; ++b)
      for (int a = 0; a < feet.n1; ++a) {
        if (!is_seen(feet, a, b)) continue;
        is_covered = false;
        for (int l = 0; l < seams_.layers; ++l) {
          const Eigen::Vector3d way = (l + 0.5) * seams_.spacing * feet.face.normal;
          add(feet.at(a, b) - way, way, feet, f);
        }
        go_on(feet, f, {a, b});
      }
    return {feet.face.origin, feet.face.normal, is_covered};
  }

  // Into the corners behind the seams beside a foot: in space, where two meet, behind both.
  void go_on(const Feet& feet, std::size_t f, Place from) {
    std::vector<Seam> seams;
    for (const Place& step : {Place{-1, 0}, Place{1, 0}, Place{0, -1}, Place{0, 1}})
      if (step[1] == 0 || feet.face.length2 > 0)
        if (const std::optional<Seam> seam = seam_beside(feet, f, from, step)) seams.push_back(*seam);
    for (const Seam& u : seams) {
      fill(feet, f, from, u, nullptr);
      for (const Seam& v : seams)
        if (u.step[1] == 0 && v.step[0] == 0) fill(feet, f, from, u, &v);
    }
  }

  // Layers below the places behind u, or behind u and v.
  void fill(const Feet& feet, std::size_t f, Place from, const Seam& u, const Seam* v) {
    const Eigen::Vector3d foot = feet.at(from[0], from[1]);
    const Eigen::Vector3d corner = v == nullptr ? u.corner : Eigen::Vector3d(u.corner + v->corner - foot);
    for (int k = 1; k <= seams_.layers + 1; ++k)
      for (int m = v == nullptr ? 0 : 1; m <= (v == nullptr ? 0 : seams_.layers + 1); ++m) {
        Place place{from[0] + k * u.step[0], from[1] + k * u.step[1]};
        if (v != nullptr) place[1] += m * v->step[1];
        for (int l = 0; l < seams_.layers; ++l) {
          const Eigen::Vector3d x =
              feet.at(place[0], place[1]) - (l + 0.5) * seams_.spacing * feet.face.normal;
          if (is_mine(u, x) && (v == nullptr || is_mine(*v, x))) add(x, corner - x, feet, f);
        }
      }
  }

  [[nodiscard]] std::optional<Seam> seam_beside(const Feet& feet, std::size_t f, Place from,
                                                Place step) const {
    const Place next{from[0] + step[0], from[1] + step[1]};
    if (is_seen(feet, next[0], next[1])) return std::nullopt;
    const Eigen::Vector3d foot = feet.at(from[0], from[1]);
    std::optional<Seam> seam = seam_of(f, foot, feet.at(next[0], next[1]) - foot);
    if (seam) seam->step = step;
    return seam;
  }

  // The nearest face of another plate that a step along face f from a foot runs against.
  [[nodiscard]] std::optional<Seam> seam_of(std::size_t f, const Eigen::Vector3d& foot,
                                            const Eigen::Vector3d& step) const {
    const Eigen::Vector3d normal = own().faces[f].normal, along = step.normalized();
    const double margin = 1e-6 * seams_.spacing;
    double nearest = 1.5 * step.norm();
    std::optional<Seam> seam;
    for (std::size_t q = 0; q < seams_.plates.size(); ++q)
      for (std::size_t g = 0; g < seams_.plates[q].faces.size(); ++g) {
        const FlatFace& other = seams_.plates[q].faces[g];
        const double against = -other.normal.dot(along), way = other.distance(foot) / against;
        if (q == p_ || against < margin || way < -margin || way >= nearest) continue;
        const Eigen::Vector3d corner = foot + way * along;
        const Eigen::Vector3d other_along = -(normal - normal.dot(other.normal) * other.normal).normalized();
        // It must stand up from the corner, in front of this face.
        if (!other.is_above(corner - 0.5 * seams_.spacing * other_along, margin)) continue;
        nearest = way;
        seam = Seam{{}, corner, along, other_along, std::pair(p_, f) < std::pair(q, g)};
      }
    return seam;
  }

  // Whether x is behind neither face, on this one's half of the corner, and in reach of it.
  [[nodiscard]] bool is_mine(const Seam& seam, const Eigen::Vector3d& x) const {
    const double margin = 1e-6 * seams_.spacing;
    const double beyond = (x - seam.corner).dot(seam.along);
    const double beyond_other = (x - seam.corner).dot(seam.other_along);
    if (beyond < -margin || beyond_other < -margin || beyond > seams_.layers * seams_.spacing) return false;
    return std::abs(beyond - beyond_other) < margin ? seam.is_first : beyond < beyond_other;
  }

  void add(const Eigen::Vector3d& x, const Eigen::Vector3d& to_surface, const Feet& feet, std::size_t f) {
    if (seams_.is_inside(x, own().part)) return;
    body_.position.push_back(x);
    body_.volume.push_back(feet.area() * seams_.spacing);
    body_.to_surface.push_back(to_surface);
    body_.plate.push_back(static_cast<std::int32_t>(body_.plates.size()));
    body_.face.push_back(static_cast<std::int32_t>(f));
  }

  const PlateSeams& seams_;
  std::size_t p_;
  Boundary& body_;
};

}  // namespace

void PlateSeams::append(std::size_t p, Boundary& body) const {
  PlateLayers(*this, p, body).run();
}

bool needs_plate_rule(const Shape& shape, double support, int dimension) {
  return !flat_faces(shape, dimension).empty() && thickness(shape, dimension) < 2.0 * support - 1e-9;
}

Boundary sample_plate(const Shape& shape, double spacing, double support, int dimension) {
  const std::vector<PlatePart> plates{{0, flat_faces(shape, dimension)}};
  const auto nowhere = [](const Eigen::Vector3d&, std::size_t) { return false; };
  Boundary plate;
  PlateSeams{plates, nowhere, nowhere, spacing, layer_count(support, spacing)}.append(0, plate);
  return plate;
}

}  // namespace sluice::fluid
