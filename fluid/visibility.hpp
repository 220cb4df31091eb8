#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "fluid/boundary.hpp"
#include "fluid/particles.hpp"
#include "fluid/thin_plate.hpp"

namespace sluice::fluid {

// Which pairs act on each other at all, by the thin-plate rule: answered for fluid near a plate, all else
// sees each other. Holds for the positions that it was made with.
template <int Dim>
class Visibility {
 public:
  // `reach` is that of the pairs asked about [m]. The layers of one face of a plate may stand out of the
  // other by as much again.
  Visibility(const Particles<Dim>& fluid, const BoundaryParticles<Dim>& boundary, double reach)
      : fluid_(fluid), boundary_(boundary), near_(boundary.plates().empty() ? 0 : fluid.node.size(), 0) {
    for (std::size_t i = 0; i < near_.size(); ++i)
      for (const Plate<Dim>& plate : boundary.plates())
        if (fluid::is_near(plate, fluid.node[i].x, 2.0 * reach)) near_[i] = 1;
  }

  // Whether a plate can concern fluid particle i, which may be an image.
  [[nodiscard]] bool is_near_plate(std::size_t i) const { return i < near_.size() && near_[i] != 0; }

  [[nodiscard]] bool fluid_sees_fluid(std::size_t i, std::size_t j) const {
    if (!is_near_plate(i) || !is_near_plate(j)) return true;
    const Vec<Dim>&x = fluid_.node[i].x, &y = fluid_.node[j].x;
    return std::none_of(boundary_.plates().begin(), boundary_.plates().end(),
                        [&](const Plate<Dim>& plate) { return separates(plate, x, y); });
  }

  [[nodiscard]] bool fluid_sees_boundary(std::size_t i, std::size_t w) const {
    const std::int32_t plate = boundary_.plate(w);
    return plate < 0 || sees_face(boundary_.plates()[static_cast<std::size_t>(plate)], boundary_.face(w),
                                  fluid_.node[i].x);
  }

 private:
  const Particles<Dim>& fluid_;
  const BoundaryParticles<Dim>& boundary_;
  std::vector<std::uint8_t> near_;
};

}  // namespace sluice::fluid
