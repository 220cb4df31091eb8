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
    if (plate < 0) return true;
    const Vec<Dim>& x = fluid_.node[i].x;
    return sees_face(boundary_.plates()[static_cast<std::size_t>(plate)], boundary_.face(w), x) &&
           !is_hidden(x, w);
  }

 private:
  // Whether another plate of the same body stands between x and the surface in front of w, where the two may
  // touch.
  [[nodiscard]] bool is_hidden(const Vec<Dim>& x, std::size_t w) const {
    const Surface<Dim>& surface = boundary_.surface(w);
    const Vec<Dim> foot = boundary_.node()[w].x + surface.depth * surface.normal;
    const Vec<Dim> before = foot + 1e-6 * (x - foot);
    const std::vector<Plate<Dim>>& plates = boundary_.plates();
    for (std::size_t p = 0; p < plates.size(); ++p)
      if (plates[p].body == boundary_.body(w) && static_cast<std::int32_t>(p) != boundary_.plate(w) &&
          crosses(plates[p], x, before))
        return true;
    return false;
  }

  const Particles<Dim>& fluid_;
  const BoundaryParticles<Dim>& boundary_;
  std::vector<std::uint8_t> near_;
};

}  // namespace sluice::fluid
