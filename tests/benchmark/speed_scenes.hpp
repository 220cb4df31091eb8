#pragma once

#include <string>
#include <vector>

#include "scene.pb.h"

namespace sluice::benchmark {

// A kind of flow whose cost is measured, at any number of particles.
struct SpeedScene {
  std::string name, title;
  int dimension;
  std::vector<double> particles;  // that the full table has
  // About that many fluid particles, running for longer than anyone measures.
  Scene (*make)(double particles);
};

const std::vector<SpeedScene>& all_speed_scenes();

}  // namespace sluice::benchmark
