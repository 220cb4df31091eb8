#pragma once

#include <span>
#include <vector>

#include "fluid/kinematics.hpp"
#include "fluid/setup.hpp"

namespace sluice::fluid {

// The mirror images of bodies, one beyond every mirrored side and every edge and corner of such sides: bodies
// of their own, whose motion is that of the original. Without a mirrored side there are none.
class BodyImages {
 public:
  explicit BodyImages(const Setup& setup);

  // The bodies and, after them, their images.
  [[nodiscard]] std::vector<Boundary> with_images(const std::vector<Boundary>& bodies) const;
  // The same of their motions; the result holds until the next call.
  [[nodiscard]] std::span<const Kinematics> with_images(std::span<const Kinematics> bodies);

 private:
  // x -> flip x + shift, by components.
  struct Reflection {
    Eigen::Vector3d flip, shift;  // 1 or -1; [m]
    [[nodiscard]] Boundary of(const Boundary& body) const;
    [[nodiscard]] Kinematics of(const Kinematics& motion) const;
  };

  std::vector<Reflection> reflections_;
  std::vector<Kinematics> motions_;
};

}  // namespace sluice::fluid
