#include "benchmark/escapes.hpp"

#include <algorithm>

namespace sluice::benchmark {

Escapes::Escapes(const Scene& scene) : scene_(scene) {
  closed_.fill(true);
  for (const int side : scene.domain().open()) closed_[static_cast<std::size_t>(side - X_MIN)] = false;
}

void Escapes::follow(const fluid::Snapshot& s) {
  left_.resize(s.density.size(), 0);
  lost_.resize(s.density.size(), 0);
  for (std::size_t i = 0; i < s.density.size(); ++i) {
    for (std::size_t side = 0; side < 2 * scene_.dimension(); ++side) {
      const double distance = beyond(&s.position[3 * i], side);
      if (!closed_[side] && distance > 0) left_[i] = 1;
      if (closed_[side] && left_[i] == 0 && distance > scene_.spacing()) lost_[i] = 1;
    }
  }
}

std::uint64_t Escapes::lost() const {
  return static_cast<std::uint64_t>(std::count(lost_.begin(), lost_.end(), 1));
}

double Escapes::beyond(const double* x, std::size_t side) const {
  const auto axis = static_cast<int>(side / 2);
  return side % 2 == 0 ? scene_.domain().min(axis) - x[axis] : x[axis] - scene_.domain().max(axis);
}

}  // namespace sluice::benchmark
