#pragma once

#include <google/protobuf/text_format.h>

#include <stdexcept>
#include <string>

#include "scene.pb.h"

namespace sluice::testing {

inline Scene parse_scene(const std::string& text) {
  Scene scene;
  if (!google::protobuf::TextFormat::ParseFromString(text, &scene))
    throw std::runtime_error("bad scene in a test");
  return scene;
}

// 50 particles in a tank; 100 steps of 1 ms in 10 frames.
inline Scene tank() {
  return parse_scene(R"(
    name: "tank" dimension: 2 spacing: 0.1 duration: 0.1
    liquid { density: 1000 max_speed: 4 }
    domain { max: [1, 2] }
    fluid { box { min: [0, 0] max: [1, 0.5] } }
    output { rate: 100 })");
}

// The tank with a gate that moves as prescribed, so that its kinematics may be streamed.
inline Scene gate() {
  Scene scene = tank();
  scene.MergeFrom(parse_scene(R"(
    body { name: "gate" box { size: [0.2, 0.4] } position: [0.5, 1]
           prescribed { constant { velocity: [0, 0.5] } } })"));
  return scene;
}

// The tank with a free ball, which needs every answer.
inline Scene ball() {
  Scene scene = tank();
  scene.MergeFrom(parse_scene(R"(
    body { name: "ball" ball { radius: 0.2 } density: 500 position: [0.5, 1.2] velocity: [0, -1] })"));
  return scene;
}

}  // namespace sluice::testing
