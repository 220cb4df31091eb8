#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

#include "fluid/boundary.hpp"
#include "fluid/model.hpp"

namespace sluice::fluid {

// The speed [m/s] at which two surfaces of different bodies, or of a body and a wall or mirrored side, close
// or part that face each other across less than about 1.6 spacings and have x between them: a film that
// particles do not resolve. The largest, if there are several; nothing, if there are none.
template <int Dim, typename Kernel>
std::optional<double> film_speed(const Model<Dim, Kernel>& model, const Vec<Dim>& x,
                                 std::span<const std::uint32_t> neighbors,
                                 const BoundaryParticles<Dim>& boundary,
                                 std::span<const Plane<Dim>> mirrors) {
  const double film = 1.6 * model.spacing;
  // Boundary particles stand half a spacing behind their surface.
  const auto distance = [&](std::uint32_t w) {
    return (boundary.node()[w].x - x).norm() - 0.5 * model.spacing;
  };
  constexpr double kFacing = -0.3;  // cosine between the normals of surfaces that face each other
  std::optional<double> fastest;
  const auto take = [&](double speed) { fastest = std::max(fastest.value_or(0.0), std::abs(speed)); };
  for (const std::uint32_t u : neighbors) {
    const double rest = film - distance(u);
    if (boundary.body(u) == 0 || rest < 0.0) continue;
    const Vec<Dim>&normal = boundary.surface(u).normal, &v = boundary.velocity(u);
    for (const std::uint32_t w : neighbors)
      if (boundary.body(w) != boundary.body(u) && distance(w) < rest &&
          normal.dot(boundary.surface(w).normal) < kFacing)
        take(normal.dot(v - boundary.velocity(w)));
    for (const Plane<Dim>& mirror : mirrors)
      if (mirror.distance(x) < rest && normal.dot(mirror.normal) < kFacing) take(normal.dot(v));
  }
  return fastest;
}

// Whether fluid at x has been pressed through a surface: the ball around a boundary particle that reaches to
// the surface is inside.
template <int Dim>
bool is_inside_boundary(const Vec<Dim>& x, std::span<const std::uint32_t> neighbors,
                        const BoundaryParticles<Dim>& boundary) {
  return std::any_of(neighbors.begin(), neighbors.end(), [&](std::uint32_t w) {
    const double depth = boundary.surface(w).depth;
    return (x - boundary.node()[w].x).squaredNorm() < depth * depth;
  });
}

}  // namespace sluice::fluid
