#pragma once

#include <functional>

#include "fluid/flat_face.hpp"

namespace sluice::fluid {

// A part of a compound that needs the thin-plate rule (thin_plate.hpp), in the compound's frame.
struct PlatePart {
  std::size_t part;  // number in the compound
  std::vector<FlatFace> faces;
};

// Appends plate p: the layers of its faces below what other parts leave of them. Where a face ends in front
// of another plate's, neither has layers in the corner behind the seam that fluid in front of both has in its
// support: each face goes on into it, up to the line that halves it.
//   is_covered(x, part): a point of the part's surface is in or on another part
//   is_inside(x, part): a point is within another part that is no plate
struct PlateSeams {
  const std::vector<PlatePart>& plates;
  std::function<bool(const Eigen::Vector3d&, std::size_t)> is_covered, is_inside;
  double spacing;
  int layers;

  void append(std::size_t p, Boundary& body) const;
};

}  // namespace sluice::fluid
