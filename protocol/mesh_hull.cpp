#include <LinearMath/btConvexHullComputer.h>
#include <fmt/format.h>

#include <vector>

#include "protocol/mesh_file.hpp"

static_assert(sizeof(btScalar) == 8, "sluice needs Bullet in double precision (pkg-config bullet-float64)");

namespace sluice::protocol {
namespace {

// The corners of the face that the edge belongs to.
std::vector<int> corners(const btConvexHullComputer::Edge* first) {
  std::vector<int> result;
  const auto* edge = first;
  do {
    result.push_back(edge->getSourceVertex());
    edge = edge->getNextEdgeOfFace();
  } while (edge != first);
  return result;
}

}  // namespace

std::string take_convex_hull(Mesh& mesh) {
  const int points = mesh.vertex_size() / 3;
  if (mesh.vertex_size() % 3 != 0 || points < 4)
    return fmt::format("{} numbers are no vertices of three each, four at least", mesh.vertex_size());
  btConvexHullComputer hull;
  hull.compute(mesh.vertex().data(), 3 * sizeof(double), points, 0, 0);

  Mesh taken;
  for (int v = 0; v < hull.vertices.size(); ++v)  // the vertices as given, which the hull rounds
    for (int a = 0; a < 3; ++a) taken.add_vertex(mesh.vertex(3 * hull.original_vertex_index[v] + a));
  for (int f = 0; f < hull.faces.size(); ++f) {
    const std::vector<int> face = corners(&hull.edges[hull.faces[f]]);
    for (std::size_t c = 1; c + 1 < face.size(); ++c)
      for (const int corner : {face[0], face[c], face[c + 1]})
        taken.add_triangle(static_cast<std::uint32_t>(corner));
  }
  if (check_surface(taken).find("inside out") != std::string::npos) {
    auto* triangle = taken.mutable_triangle();
    for (int t = 0; t < triangle->size(); t += 3) triangle->SwapElements(t, t + 1);
  }
  if (const std::string problem = check_surface(taken); !problem.empty())
    return "the convex hull of the vertices is no body: " + problem;
  *mesh.mutable_vertex() = taken.vertex();
  *mesh.mutable_triangle() = taken.triangle();
  return "";
}

}  // namespace sluice::protocol
