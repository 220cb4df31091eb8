#pragma once

#include <cstdint>
#include <functional>
#include <tuple>
#include <utility>
#include <vector>

#include "fluid/parallel.hpp"
#include "fluid/particles.hpp"
#include "fluid/setup.hpp"

namespace sluice::fluid {

// Momentum [N s], and about the origin [N m s].
struct Impulse {
  Eigen::Vector3d linear = Eigen::Vector3d::Zero(), angular = Eigen::Vector3d::Zero();
};

// Images of the fluid particles near periodic and mirrored sides, appended to the arrays of the particles so
// that the sweeps need not know of them. Without such a side there are none and nothing is done.
template <int Dim>
class Halo {
 public:
  // Images stand for particles up to `width` [m] beyond the sides.
  Halo(const Period& period, const Mirrors& mirrors, double width);

  [[nodiscard]] bool is_used() const { return !sides_.empty(); }
  [[nodiscard]] bool has_mirrors() const;

  // Puts particles that left through a periodic side back in through the other, and takes those that crossed
  // a mirrored side for their images, which is the same flow.
  void wrap(Particles<Dim>& fluid);
  // What particles have left at mirrored sides by being taken for their images, since it was last asked for.
  Impulse take_impulse() { return std::exchange(impulse_, {}); }
  // Removes the images, and makes them anew from the present positions, those that are `needed` where they
  // stand. Returns their nodes.
  static void remove(Particles<Dim>& fluid);
  std::vector<Node<Dim>> find(const Particles<Dim>& fluid,
                              const std::function<bool(const Vec<Dim>&)>& needed);
  // Whether a point is beyond the sides by `reach` [m] or less.
  [[nodiscard]] bool is_within(const Vec<Dim>& x, double reach) const;
  // Appends the images that find() found, in the order given.
  void append(Particles<Dim>& fluid, const std::vector<std::uint32_t>& order);

  // The particle that entry k of the arrays is, or is the image of.
  [[nodiscard]] std::size_t particle(std::size_t k, const Particles<Dim>& fluid) const {
    return k < fluid.size() ? k : image_[k - fluid.size()].of;
  }

  // Copies to the images what moved, and what sweep 1 and the stress left.
  void refresh_nodes(Particles<Dim>& fluid) const;
  void refresh_fits(Particles<Dim>& fluid) const;
  void refresh_sources(Particles<Dim>& fluid, const Parallel& parallel) const;

  auto state() { return std::tie(image_); }

 private:
  // Stands at flip x + shift, by components; vectors and tensors are flipped alike.
  struct Image {
    std::uint32_t of;
    Vec<Dim> flip;   // 1, or -1 across a mirror
    Vec<Dim> shift;  // [m]

    [[nodiscard]] Vec<Dim> vector(const Vec<Dim>& v) const { return flip.cwiseProduct(v); }
    [[nodiscard]] Mat<Dim> tensor(const Mat<Dim>& m) const {
      return flip.asDiagonal() * m * flip.asDiagonal();
    }
    [[nodiscard]] Node<Dim> node(const Node<Dim>& original) const;
  };
  // One side, or one way round a period: where images stand, of what is nearer to it than the halo's width.
  struct Side {
    int axis;
    double at;      // [m]
    double inward;  // 1 at a lower side, -1 at an upper one
    double flip;    // of the axis
    double shift;   // [m]
    [[nodiscard]] double distance(const Vec<Dim>& x) const { return inward * (x[axis] - at); }
  };

  void reflect(const Side& side, double mass, Node<Dim>& node);

  std::vector<Side> sides_;
  double width_;
  std::vector<Image> image_;
  Impulse impulse_;
};

extern template class Halo<2>;
extern template class Halo<3>;

}  // namespace sluice::fluid
