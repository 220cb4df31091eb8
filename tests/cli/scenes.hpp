#pragma once

#include <string>

namespace sluice::test {

// Small, quick and right; tests break it one line at a time. The body stands on lines 7 to 12.
inline const std::string kSmallScene = R"(name: "small"
dimension: 2
spacing: 0.01
duration: 0.02
domain { max: [0.4, 0.3] open: Y_MAX }
fluid { box { min: [0, 0] max: [0.1, 0.1] } }
body {
  name: "gate"
  box { size: [0.02, 0.12] }
  position: [0.11, 0.06]
  prescribed { constant { velocity: [0, 0.7] } }
}
output { rate: 100 }
)";

// `text` with the first `from` replaced; the caller knows that it is there.
inline std::string with(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

}  // namespace sluice::test
