#include "fluid/flat_face.hpp"

namespace sluice::fluid {

namespace {

std::vector<FlatFace> edges(const std::vector<Eigen::Vector2d>& vertices) {
  std::vector<FlatFace> faces;
  for (std::size_t k = 0; k < vertices.size(); ++k) {
    const Eigen::Vector2d a = vertices[k], b = vertices[(k + 1) % vertices.size()];
    const Eigen::Vector2d t = (b - a).normalized();
    faces.push_back({{a.x(), a.y(), 0}, {t.x(), t.y(), 0}, {0, 0, 0}, {t.y(), -t.x(), 0}, (b - a).norm(), 0});
  }
  return faces;
}

std::vector<FlatFace> faces_of(const BoxShape& box, int dimension) {
  const Eigen::Vector3d h = box.half_size;
  if (dimension == 2) return edges({{-h.x(), -h.y()}, {h.x(), -h.y()}, {h.x(), h.y()}, {-h.x(), h.y()}});
  std::vector<FlatFace> faces;
  for (int a = 0; a < 3; ++a)
    for (const double side : {-1.0, 1.0}) {
      const int b = (a + 1) % 3, c = (a + 2) % 3;
      Eigen::Vector3d origin = -h;
      origin[a] = side * h[a];
      faces.push_back({origin, Eigen::Vector3d::Unit(b), Eigen::Vector3d::Unit(c),
                       side * Eigen::Vector3d::Unit(a), 2 * h[b], 2 * h[c]});
    }
  return faces;
}

}  // namespace

std::vector<FlatFace> flat_faces(const Shape& shape, int dimension) {
  if (const auto* box = std::get_if<BoxShape>(&shape)) return faces_of(*box, dimension);
  const auto* polygon = std::get_if<PolygonShape>(&shape);
  return polygon != nullptr && is_convex(*polygon) ? edges(polygon->vertices) : std::vector<FlatFace>{};
}

}  // namespace sluice::fluid
