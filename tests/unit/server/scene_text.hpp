#pragma once

#include <google/protobuf/text_format.h>

#include <stdexcept>
#include <string>

#include "protocol/scene_check.hpp"

namespace sluice::testing {

// A tank 1 m wide and 2 m high, spacing 0.1 m, speed of sound 40 m/s, with what `text` adds or replaces.
inline Scene tank_with(const std::string& text) {
  Scene scene;
  for (const std::string& part : {std::string("name: 'tank' dimension: 2 spacing: 0.1 duration: 1 liquid { "
                                              "max_speed: 4 } domain { max: [1, 2] }"),
                                  text}) {
    Scene parsed;
    if (!google::protobuf::TextFormat::ParseFromString(part, &parsed))
      throw std::runtime_error("bad scene in a test");
    scene.MergeFrom(parsed);
  }
  return protocol::with_defaults(scene);
}

}  // namespace sluice::testing
