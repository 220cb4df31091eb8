#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "clients/preflight/checks.hpp"
#include "clients/rigid/convert.hpp"

namespace sluice::clients {
namespace {

constexpr double kFewestLayers = 10;  // particles of depth below which waves and pressure are badly resolved

void check_inside(const RegionLayout& region, const Layout& layout, Findings& findings) {
  for (int side = 0; side < 2 * layout.dimension; ++side) {
    const Eigen::Vector3d axis = Eigen::Vector3d::Unit(side / 2);
    const double excess = beyond(extent(region, axis, layout.dimension), layout.tank, side);
    if (excess > layout.tolerance)
      findings.error(region.field,
                     fmt::format("liquid reaches {:.4g} m beyond {} of the domain; shrink or move it, or "
                                 "enlarge the domain",
                                 excess, side_name(side)));
  }
}

void check_apart(std::size_t r, const Layout& layout, Findings& findings) {
  for (std::size_t other = 0; other < r; ++other) {
    const double depth =
        penetration(layout.regions[r].pieces, layout.regions[other].pieces, layout.dimension);
    if (depth > layout.tolerance)
      findings.error(layout.regions[r].field,
                     fmt::format("overlaps {} by {:.4g} m, and liquid would stand there twice; "
                                 "let them touch, or merge them into one polygon",
                                 layout.regions[other].field, depth));
  }
}

// Along gravity; without gravity, the smallest size.
double depth_of(const RegionLayout& region, const Layout& layout) {
  const Eigen::Vector3d gravity = to_vector(layout.scene.gravity());
  const auto size = [&](const Eigen::Vector3d& direction) {
    const rigid::Interval range = extent(region, direction, layout.dimension);
    return range.max - range.min;
  };
  if (gravity.norm() > 0) return size(gravity.normalized());
  double smallest = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < layout.dimension; ++axis)
    smallest = std::min(smallest, size(Eigen::Vector3d::Unit(axis)));
  return smallest;
}

void check_depth(const RegionLayout& region, const Layout& layout, Findings& findings) {
  const double depth = depth_of(region, layout), layers = depth / layout.spacing;
  if (layers >= kFewestLayers * (1 - 1e-9)) return;
  findings.warning(region.field,
                   fmt::format("{:.4g} m of depth are {:.1f} particles of {:g} m, fewer than {:g}; a spacing "
                               "of {:.3g} m or less would resolve it",
                               depth, layers, layout.spacing, kFewestLayers, depth / kFewestLayers));
}

}  // namespace

void check_liquid(const Layout& layout, Findings& findings) {
  const auto& openings = layout.scene.opening();
  const bool is_fed = std::any_of(openings.begin(), openings.end(),
                                  [](const Opening& opening) { return opening.has_inflow(); });
  if (layout.regions.empty() && !is_fed)
    findings.error("fluid", "the scene has no liquid; add a fluid region");
  for (std::size_t r = 0; r < layout.regions.size(); ++r) {
    check_inside(layout.regions[r], layout, findings);
    check_apart(r, layout, findings);
    check_depth(layout.regions[r], layout, findings);
  }
}

}  // namespace sluice::clients
