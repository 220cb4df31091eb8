#pragma once

#include <cmath>
#include <cstdint>
#include <random>

namespace sluice::benchmark {

// Random numbers that are the same everywhere: the engine is, the standard library's distributions are not.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  // In [least, most).
  double uniform(double least, double most) {
    constexpr double kStep = 1.0 / (1ULL << 53);
    return least + (most - least) * kStep * static_cast<double>(engine_() >> 11);
  }
  // The logarithm is evenly spread.
  double spread(double least, double most) { return std::exp(uniform(std::log(least), std::log(most))); }
  // From least to most, both included.
  int integer(int least, int most) {
    return least + static_cast<int>(uniform(0, static_cast<double>(most - least) + 1));
  }
  bool chance(double share) { return uniform(0, 1) < share; }

 private:
  std::mt19937_64 engine_;
};

}  // namespace sluice::benchmark
