#pragma once

#include <string>
#include <vector>

#include "validation/support/curve.hpp"

namespace sluice::validation {

// A body 0.4 m high afloat in a tank 1.6 m wide, two dimensions; the box is 0.6 m wide.
struct Float {
  std::string scene = "floating_box";  // or floating_cylinder
  double density = 300;                // [kg/m^3], of water's 1000
  double lift = 0;                     // starts above its level [m]
  double duration = 10;                // [s]
  std::vector<std::string> overrides;  // further ones
};

struct FloatResult {
  double level = 0;       // draft of Archimedes [m]
  Curve draft;            // over time: below the level that the liquid has with it [m]
  Curve height;           // of the centre [m]
  Curve force;            // upward, at every exchange [N/m]
  double weight = 0;      // [N/m]
  double iterations = 0;  // an exchange
};

// Draft [m] at which the body displaces its weight.
double archimedes_draft(const std::string& scene, double density);

FloatResult float_body(const Float& what);

}  // namespace sluice::validation
