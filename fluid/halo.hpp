#pragma once

#include <cstdint>
#include <tuple>
#include <vector>

#include "fluid/particles.hpp"
#include "fluid/setup.hpp"

namespace sluice::fluid {

// Images of the fluid particles near periodic sides, appended to the arrays of the particles so that the
// sweeps need not know of them. Without a periodic axis there are none and nothing is done.
template <int Dim>
class Halo {
 public:
  // Images stand for particles up to `width` [m] beyond the sides.
  Halo(const Period& period, double width);

  [[nodiscard]] bool is_used() const { return is_used_; }

  // Puts particles that left through a periodic side back in through the other.
  void wrap(Particles<Dim>& fluid) const;
  // Removes the images, and makes them anew from the present positions. Returns their nodes.
  static void remove(Particles<Dim>& fluid);
  std::vector<Node<Dim>> find(const Particles<Dim>& fluid);
  // Appends the images that find() found, in the order given.
  void append(Particles<Dim>& fluid, const std::vector<std::uint32_t>& order);

  // The particle that entry k of the arrays is, or is the image of.
  [[nodiscard]] std::size_t particle(std::size_t k, const Particles<Dim>& fluid) const {
    return k < fluid.size() ? k : image_[k - fluid.size()].of;
  }

  // Copies to the images what moved, and what sweep 1 and the stress left.
  void refresh_nodes(Particles<Dim>& fluid) const;
  void refresh_sources(Particles<Dim>& fluid) const;

  auto state() { return std::tie(image_); }

 private:
  struct Image {
    std::uint32_t of;
    Vec<Dim> shift;  // [m]
  };

  Vec<Dim> lower_, length_;
  double width_;
  bool is_used_;
  std::vector<Image> image_;
};

extern template class Halo<2>;
extern template class Halo<3>;

}  // namespace sluice::fluid
