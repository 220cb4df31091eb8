#pragma once

#include <string>

#include "protocol/scene_file.hpp"
#include "temporary_directory.hpp"

namespace sluice::protocol {

// A scene without faults. Tests spoil one line of it, so that its number is the line in the error.
inline const std::string kScene = R"(name: "gate"
dimension: 2
spacing: 0.01
duration: 1.5
liquid { viscosity: 1e-3 }
domain { max: [1, 0.5] }
fluid { box { min: [0, 0] max: [0.3, 0.3] } }
body {
  name: "gate"
  box { size: [0.1, 0.2] }
  position: [0.5, 0.3]
  density: 500
}
body {
  name: "ball"
  ball { radius: 0.05 }
  position: [0.8, 0.3]
  prescribed { keyframes { key { time: 0 }
    key { time: 0.5 offset: [0, 0.1] } } }
}
)";

// kScene with line `number`, from 1, replaced.
inline std::string with_line(int number, const std::string& line) {
  std::size_t begin = 0;
  for (int i = 1; i < number; ++i) begin = kScene.find('\n', begin) + 1;
  return kScene.substr(0, begin) + line + kScene.substr(kScene.find('\n', begin));
}

// The errors of a scene text as printed, with the directory left out; empty when there are none.
inline std::string errors_of(const std::string& text, const std::vector<std::string>& overrides = {},
                             const std::string& name = "a.scene") {
  const TemporaryDirectory directory;
  const std::string path = directory.write(name, text);
  std::string errors;
  try {
    SceneFile::load(path, overrides);
  } catch (const SceneError& error) {
    errors = error.what();
  }
  const std::string prefix = directory.path().string() + "/";
  for (std::size_t at = errors.find(prefix); at != std::string::npos; at = errors.find(prefix))
    errors.erase(at, prefix.size());
  return errors;
}

}  // namespace sluice::protocol
