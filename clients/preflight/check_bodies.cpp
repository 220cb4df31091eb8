#include <fmt/format.h>

#include <algorithm>

#include "clients/preflight/checks.hpp"

namespace sluice::clients {
namespace {

double support_of(const Layout& layout) {
  return 2 * layout.scene.formulation().smoothing() * layout.spacing;
}

// Without the rule, in front of a body thinner than two supports liquid sees the particles of its other side,
// and behind one thinner than a support the liquid there.
void warn_without_rule(const BodyLayout& body, const Layout& layout, Findings& findings) {
  const double support = support_of(layout), width = body.thickness_without_plate_rule;
  const bool is_round = std::holds_alternative<rigid::Ball>(body.placed.shape);
  findings.warning(
      body.field,
      fmt::format(
          "body '{}' is {:.4g} m thick at its thinnest, less than {} of {:.4g} m: {}; {}take a spacing "
          "below {:.3g} m",
          body.name, width, width < support ? "the support" : "two supports", support,
          width < support ? "liquid on opposite sides interacts through it"
                          : "liquid on one side feels the pressure of the other",
          is_round ? "" : "make it a compound of boxes or convex polygons, which keep their sides apart, or ",
          layout.spacing * width / (2 * support)));
}

void check_thickness(const BodyLayout& body, const Layout& layout, Findings& findings) {
  const double width = body.thickness, support = support_of(layout);
  if (width < layout.spacing * (1 - 1e-9))
    findings.error(
        body.field,
        fmt::format("body '{}' is {:.4g} m thick, thinner than one particle spacing of {:g} m; make "
                    "it thicker or the spacing smaller",
                    body.name, width, layout.spacing));
  else if (layout.scene.formulation().boundary() == FORCES) {
    if (width < support)
      findings.error(
          body.field,
          fmt::format("body '{}' is {:.4g} m thick, thinner than the support of {:.4g} m, and "
                      "formulation.boundary FORCES does not keep its sides apart; make it thicker, "
                      "the spacing at most {:.3g} m, or leave boundary out",
                      body.name, width, support, layout.spacing * width / support));
  } else if (body.thickness_without_plate_rule < 2 * support)
    warn_without_rule(body, layout, findings);
  else if (width < 2 * support)
    findings.warning(
        body.field,
        fmt::format("body '{}' is {:.4g} m thick, thinner than two supports of {:.4g} m: the "
                    "thin-plate rule keeps its sides apart; nothing to do unless its edges matter",
                    body.name, width, support));
}

void check_parts(const BodyLayout& body, const Layout& layout, Findings& findings) {
  const auto* compound = std::get_if<rigid::Compound>(&body.placed.shape);
  if (compound == nullptr) return;
  const std::vector<Placed>& parts = compound->parts;
  for (std::size_t a = 0; a < parts.size(); ++a)
    for (std::size_t b = 0; b < a; ++b) {
      const double depth = penetration({parts[a]}, {parts[b]}, layout.dimension);
      if (depth > layout.tolerance)
        return findings.error(
            body.field + ".compound",
            fmt::format("parts of body '{}' overlap by {:.4g} m, and their mass would count twice; let them "
                        "touch",
                        body.name, depth));
    }
}

void check_against_liquid(const BodyLayout& body, const Layout& layout, Findings& findings) {
  if (body.displaces_fluid) return;
  for (const RegionLayout& region : layout.regions) {
    const double depth = penetration({body.placed}, region.pieces, layout.dimension);
    if (depth > layout.tolerance)
      findings.error(
          body.field + ".position",
          fmt::format("body '{}' stands {:.4g} m deep in the liquid of {}; move one of them, or set "
                      "displaces_fluid: true to cut the liquid out",
                      body.name, depth, region.field));
  }
}

// Bodies that are joined overlap at the joint.
bool are_joined(const BodyLayout& a, const BodyLayout& b, const Scene& scene) {
  return std::any_of(scene.joint().begin(), scene.joint().end(), [&](const Joint& joint) {
    return (joint.body() == a.name && joint.to() == b.name) ||
           (joint.body() == b.name && joint.to() == a.name);
  });
}

void check_against_bodies(std::size_t b, const Layout& layout, Findings& findings) {
  const BodyLayout& body = layout.bodies[b];
  for (std::size_t other = 0; other < b; ++other) {
    if (are_joined(body, layout.bodies[other], layout.scene)) continue;
    const double depth = penetration({body.placed}, {layout.bodies[other].placed}, layout.dimension);
    if (depth > layout.tolerance)
      findings.error(
          body.field + ".position",
          fmt::format("body '{}' overlaps body '{}' by {:.4g} m; move them apart (touching is allowed)",
                      body.name, layout.bodies[other].name, depth));
  }
}

void check_against_walls(const BodyLayout& body, const Layout& layout, Findings& findings) {
  for (int side = 0; side < 2 * layout.dimension; ++side) {
    if (!layout.tank.closed[side]) continue;
    const rigid::Interval range =
        rigid::extent(body.placed.shape, body.placed.pose, Eigen::Vector3d::Unit(side / 2), layout.dimension);
    const double excess = beyond(range, layout.tank, side);
    if (excess > layout.tolerance)
      findings.error(
          body.field + ".position",
          fmt::format(
              "body '{}' reaches {:.4g} m through the wall at {}; move it inside, enlarge the domain, "
              "or open that side",
              body.name, excess, side_name(side)));
  }
}

}  // namespace

void check_bodies(const Layout& layout, Findings& findings) {
  for (std::size_t b = 0; b < layout.bodies.size(); ++b) {
    check_thickness(layout.bodies[b], layout, findings);
    check_parts(layout.bodies[b], layout, findings);
    check_against_liquid(layout.bodies[b], layout, findings);
    check_against_bodies(b, layout, findings);
    check_against_walls(layout.bodies[b], layout, findings);
  }
}

}  // namespace sluice::clients
