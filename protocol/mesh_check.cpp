#include <fmt/format.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <map>

#include "protocol/mesh_file.hpp"

namespace sluice::protocol {
namespace {

using Edge = std::pair<std::uint32_t, std::uint32_t>;

Eigen::Vector3d vertex(const Mesh& mesh, int corner) {
  const int first = 3 * static_cast<int>(mesh.triangle(corner));
  return {mesh.vertex(first), mesh.vertex(first + 1), mesh.vertex(first + 2)};
}

std::string place(const Eigen::Vector3d& x) {
  return fmt::format("({:g}, {:g}, {:g}) m", x.x(), x.y(), x.z());
}

std::string check_corners(const Mesh& mesh) {
  if (mesh.vertex_size() % 3 != 0)
    return fmt::format("{} numbers are no vertices of three each", mesh.vertex_size());
  if (mesh.triangle_size() % 3 != 0)
    return fmt::format("{} corners are no triangles of three each", mesh.triangle_size());
  if (mesh.triangle_size() < 12) return "fewer than four triangles enclose nothing";
  for (int c = 0; c < mesh.triangle_size(); ++c)
    if (mesh.triangle(c) >= static_cast<std::uint32_t>(mesh.vertex_size() / 3))
      return fmt::format("triangle {} has a vertex {}, but there are {}", c / 3, mesh.triangle(c),
                         mesh.vertex_size() / 3);
  for (int c = 0; c < mesh.triangle_size(); c += 3) {
    const Eigen::Vector3d a = vertex(mesh, c), b = vertex(mesh, c + 1), d = vertex(mesh, c + 2);
    if (!((b - a).cross(d - a).norm() > 0))
      return fmt::format("triangle {} at {} has no area; remove it", c / 3, place(a));
  }
  return "";
}

// Every edge belongs to two triangles, which go along it in opposite directions.
std::string check_edges(const Mesh& mesh) {
  std::map<Edge, int> owner;  // corner at which the edge starts
  const auto next = [](int c) { return c % 3 == 2 ? c - 2 : c + 1; };
  for (int c = 0; c < mesh.triangle_size(); ++c) {
    const auto [first, fresh] = owner.emplace(Edge{mesh.triangle(c), mesh.triangle(next(c))}, c);
    if (!fresh)
      return fmt::format(
          "triangles {} and {} go along the edge at {} in the same direction; turn one of them round, or "
          "remove "
          "it where three meet",
          first->second / 3, c / 3, place(vertex(mesh, c)));
  }
  for (const auto& [edge, c] : owner)
    if (!owner.contains({edge.second, edge.first}))
      return fmt::format(
          "triangle {} has no neighbour at the edge from {} to {}: the surface is open; close it", c / 3,
          place(vertex(mesh, c)), place(vertex(mesh, next(c))));
  return "";
}

double volume(const Mesh& mesh) {
  double six = 0;
  for (int c = 0; c < mesh.triangle_size(); c += 3)
    six += vertex(mesh, c).dot(vertex(mesh, c + 1).cross(vertex(mesh, c + 2)));
  return six / 6;
}

}  // namespace

std::string check_surface(const Mesh& mesh) {
  if (std::string problem = check_corners(mesh); !problem.empty()) return problem;
  if (std::string problem = check_edges(mesh); !problem.empty()) return problem;
  if (volume(mesh) <= 0)
    return "the triangles go round clockwise seen from outside; turn the surface inside out";
  return "";
}

}  // namespace sluice::protocol
