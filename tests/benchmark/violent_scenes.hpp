#pragma once

#include <string>
#include <vector>

#include "scene.pb.h"

namespace sluice::benchmark {

struct ViolentScene {
  std::string name;
  Scene scene;
};

// Columns that break and hit the far wall, columns that meet, drops that fall on a pool: 16 in the plane with
// 280 to 2,000 particles, 8 in space with 430 to 2,500, over 15 times the column's t sqrt(2 g/a) in the plane
// and 8 in space. `quick`: the coarsest of every kind. Dimension 2 or 3.
std::vector<ViolentScene> violent_scenes(int dimension, bool quick);

}  // namespace sluice::benchmark
