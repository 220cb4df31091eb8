#pragma once

#include <string>
#include <vector>

namespace sluice::benchmark {

// A named way to solve a scene: what it changes of the scene, as `sluice run --set` does.
struct Formulation {
  std::string name, meaning;
  std::vector<std::string> overrides;
};

// The first is the scenes' own, the defaults. The stated bounds are about it.
const std::vector<Formulation>& all_formulations();

}  // namespace sluice::benchmark
