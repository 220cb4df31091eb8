#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "fluid/solver.hpp"
#include "scene.pb.h"

namespace sluice::benchmark {

// Counts particles that have gone through a wall.
class Escapes {
 public:
  // Of a scene with its defaults.
  explicit Escapes(const Scene& scene);

  // Looks at all particles: one that is further than a spacing behind a closed side, and never was beyond an
  // open one, is lost.
  void follow(const fluid::Snapshot& snapshot);
  [[nodiscard]] std::uint64_t lost() const;

 private:
  [[nodiscard]] double beyond(const double* x, std::size_t side) const;  // [m]

  Scene scene_;
  std::array<bool, 6> closed_;
  std::vector<char> left_, lost_;  // per particle
};

}  // namespace sluice::benchmark
