#pragma once

#include <utility>
#include <vector>

#include "rigid/world.hpp"

namespace sluice::rigid {

inline BodySpec body(Shape shape, double mass, const Eigen::Vector3d& position = Eigen::Vector3d::Zero()) {
  BodySpec spec;
  spec.name = "body";
  spec.shape = std::move(shape);
  spec.mass = mass;
  spec.pose.position = position;
  return spec;
}

inline WorldSpec world(int dimension, std::vector<BodySpec> bodies,
                       const Eigen::Vector3d& gravity = {0, 0, 0}) {
  WorldSpec spec;
  spec.dimension = dimension;
  spec.gravity = gravity;
  spec.bodies = std::move(bodies);
  return spec;
}

}  // namespace sluice::rigid
