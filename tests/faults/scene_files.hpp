#pragma once

#include <filesystem>
#include <fstream>
#include <string>

namespace sluice::testing {

inline std::filesystem::path write_file(const std::filesystem::path& path, const std::string& text) {
  std::ofstream(path) << text;
  return path;
}

// A small tank that runs for longer than any test waits.
inline const std::string kEndlessTank = R"(
name: "endless"
dimension: 2
spacing: 0.05
duration: 100000
liquid { density: 1000 max_speed: 4 }
domain { max: [1, 2] }
fluid { box { min: [0, 0] max: [1, 0.4] } }
output { rate: 100 }
)";
inline const std::string kFreeBall = R"(
body { name: "ball" ball { radius: 0.2 } density: 500 position: [0.5, 1.2] }
)";
inline const std::string kPrescribedGate = R"scene(
body { name: "gate" box { size: [0.4, 0.4] } position: [0.5, 1.2] prescribed { expression { y: "0.1*sin(t)" } } }
)scene";

}  // namespace sluice::testing
