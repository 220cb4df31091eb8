#pragma once

#include <span>

#include "fluid/solver.hpp"
#include "protocol/liquids.hpp"

namespace sluice::server {

// Ends a run that has gone wrong before it can do harm. A particle's state must be finite; its density within
// half of its liquid's rho0; its speed below that of sound; its place no further outside the tank than the
// tank is large.
class Guard {
 public:
  explicit Guard(const Scene& scene);

  // Throws Stop (UNSTABLE) naming the first particle that breaks a rule, its place and the time [s].
  void check(const fluid::Snapshot& state, double time) const;
  // The same for the forces on the bodies.
  void check(std::span<const fluid::Wrench> wrenches, double time) const;

 private:
  [[nodiscard]] std::string fault(const fluid::Snapshot& state, std::size_t particle) const;

  const Scene& scene_;
  std::vector<protocol::LiquidProperties> liquids_;
  Eigen::Vector3d min_, max_;  // the tank grown by its size on every side [m]
};

}  // namespace sluice::server
