#pragma once

#include <optional>
#include <string>
#include <vector>

#include "clients/preflight/findings.hpp"
#include "rigid/overlap.hpp"
#include "rigid/world.hpp"

namespace sluice::clients {

using rigid::Placed;

struct BodyLayout {
  std::string field, name;  // "body[0]"
  Placed placed;
  rigid::MotionPtr motion;  // null: free, or its motion is an error
  std::vector<double> key_times;
  double motion_end;  // of the run, or where the motion releases the body [s]
  bool displaces_fluid;
  double volume;                        // [m^3], [m^2] in two dimensions
  double thickness;                     // where it is thinnest [m]
  double thickness_without_plate_rule;  // of what the rule does not know
};

struct RegionLayout {
  std::string field;           // "fluid[0]"
  std::vector<Placed> pieces;  // convex; together the region
  double volume;               // [m^3], [m^2] in two dimensions
};

// The scene as shapes, with its defaults filled in.
struct Layout {
  Scene scene;
  int dimension;
  double spacing;
  double tolerance;  // overlaps up to this count as touching [m]
  rigid::Tank tank;
  std::vector<RegionLayout> regions;
  std::vector<BodyLayout> bodies;
};

// Bodies whose shape cannot be used, and motions that cannot, are reported and left out.
Layout lay_out(const Scene& scene, Findings& findings);

rigid::Interval extent(const RegionLayout& region, const Eigen::Vector3d& direction, int dimension);

// Largest penetration over all pairs of pieces [m].
double penetration(const std::vector<Placed>& a, const std::vector<Placed>& b, int dimension);

// "x_min", "y_max" ...; 2 axis + upper.
std::string side_name(int side);
// How far the interval reaches beyond a side of the tank [m]; negative when it stays inside.
double beyond(const rigid::Interval& range, const rigid::Tank& tank, int side);

}  // namespace sluice::clients
