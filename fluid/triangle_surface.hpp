#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace sluice::fluid {

// A closed surface of triangles, counter-clockwise seen from outside, and the distance from it.
class TriangleSurface {
 public:
  using Triangle = std::array<std::uint32_t, 3>;

  TriangleSurface(std::vector<Eigen::Vector3d> vertices, std::vector<Triangle> triangles);
  ~TriangleSurface();

  [[nodiscard]] const std::vector<Eigen::Vector3d>& vertices() const { return vertices_; }
  [[nodiscard]] double volume() const;

  struct Nearest {
    Eigen::Vector3d point;
    double signed_distance;  // [m], negative inside
  };
  // Exact; the sign is that of the pseudonormal at the nearest point, weighted by angles (J. A. Baerentzen,
  // H. Aanaes, IEEE Trans. Vis. Comput. Graph. 11 (2005) 243).
  [[nodiscard]] Nearest nearest(const Eigen::Vector3d& x) const;

 private:
  struct Tree;

  std::vector<Eigen::Vector3d> vertices_;
  std::vector<Triangle> triangles_;
  // Of every triangle: of its corners, of the sides from each corner to the next, of the face.
  struct Normals {
    std::array<Eigen::Vector3d, 3> corner, side;
    Eigen::Vector3d face;
  };
  std::vector<Normals> normals_;
  std::unique_ptr<Tree> tree_;
};

}  // namespace sluice::fluid
