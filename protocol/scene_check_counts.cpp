#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "protocol/field_check.hpp"

namespace sluice::protocol {
namespace {

// The solver tells 2^27 particles apart, images among them, of some 400 bytes each; cells cover the domain.
constexpr double kMostParticles = 1e8;
constexpr double kMostDomainSites = 4e9;

// Upper bound of the lattice points in a box with these edges [m]. In floating point: counts that do not fit
// into any integer are what this looks for.
template <typename Edges>
double sites(const Edges& edges, double spacing) {
  double count = 1;
  for (const double edge : edges) count *= std::ceil(edge / spacing) + 1;
  return count;
}

std::vector<double> difference(const Vector& max, const Vector& min) {
  std::vector<double> edges(max.begin(), max.end());
  for (std::size_t a = 0; a < edges.size() && a < static_cast<std::size_t>(min.size()); ++a)
    edges[a] -= min[static_cast<int>(a)];
  return edges;
}

std::vector<double> edges_of(const Polygon& polygon) {
  const auto by_x = [](const Point& a, const Point& b) { return a.x() < b.x(); };
  const auto by_y = [](const Point& a, const Point& b) { return a.y() < b.y(); };
  const auto [left, right] = std::minmax_element(polygon.vertex().begin(), polygon.vertex().end(), by_x);
  const auto [low, high] = std::minmax_element(polygon.vertex().begin(), polygon.vertex().end(), by_y);
  return {right->x() - left->x(), high->y() - low->y()};
}

std::vector<double> edges_of(const FluidRegion& region, int dimension) {
  if (region.has_box()) return difference(region.box().max(), region.box().min());
  if (region.has_polygon()) return edges_of(region.polygon());
  return std::vector<double>(static_cast<std::size_t>(dimension), 2 * region.ball().radius());
}

std::vector<double> edges_of(const Mesh& mesh) {
  if (mesh.vertex_size() < 3) return {0, 0, 0};  // its file could not be read
  std::vector<double> edges;
  for (int a = 0; a < 3; ++a) {
    double low = mesh.vertex(a), high = low;
    for (int v = a; v < mesh.vertex_size(); v += 3) {
      low = std::min(low, mesh.vertex(v));
      high = std::max(high, mesh.vertex(v));
    }
    edges.push_back(high - low);
  }
  return edges;
}

template <typename WithShape>
std::vector<double> edges_of_simple(const WithShape& body, int dimension) {
  if (body.has_box()) return {body.box().size().begin(), body.box().size().end()};
  if (body.has_polygon()) return edges_of(body.polygon());
  if (body.has_cylinder())
    return {2 * body.cylinder().radius(), 2 * body.cylinder().radius(), body.cylinder().length()};
  if (body.has_mesh()) return edges_of(body.mesh());
  return std::vector<double>(static_cast<std::size_t>(dimension), 2 * body.ball().radius());
}

double sites_of(const Body& body, int dimension, double spacing) {
  if (!body.has_compound()) return sites(edges_of_simple(body, dimension), spacing);
  double sum = 0;
  for (const Part& part : body.compound().part()) sum += sites(edges_of_simple(part, dimension), spacing);
  return sum;
}

}  // namespace

void check_counts(const Scene& scene, FieldCheck& check) {
  double fluid = 0;
  double bodies = 0;
  for (const auto& region : scene.fluid())
    fluid += sites(edges_of(region, check.dimension()), scene.spacing());
  for (const auto& body : scene.body()) bodies += sites_of(body, check.dimension(), scene.spacing());
  const double domain = sites(difference(scene.domain().max(), scene.domain().min()), scene.spacing());
  const auto check_one = [&](double count, double most, const char* what) {
    if (count > most)
      check.report("spacing",
                   fmt::format("{} m makes about {:.2g} {}, at most {:.2g} are supported; use a larger "
                               "spacing or a smaller scene",
                               scene.spacing(), count, what, most));
  };
  check_one(fluid, kMostParticles, "fluid particles");
  check_one(bodies, kMostParticles, "particles in bodies");
  check_one(domain, kMostDomainSites, "lattice sites in the domain");
}

}  // namespace sluice::protocol
