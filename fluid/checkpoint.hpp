#pragma once

#include <optional>
#include <tuple>

namespace sluice::fluid {

// A copy in memory of what a step changes. The parts are given as a tuple of references, always the same
// ones in the same order; memory of an earlier copy is used again.
template <typename... Parts>
class Checkpoint {
 public:
  void save(const std::tuple<Parts&...>& parts) {
    if (copy_) {
      *copy_ = parts;
    } else {
      copy_.emplace(parts);
    }
  }

  // Puts everything back, to the last bit. Precondition: something was saved. It stays saved.
  void restore(std::tuple<Parts&...> parts) const { parts = *copy_; }

  [[nodiscard]] bool is_empty() const { return !copy_; }

 private:
  std::optional<std::tuple<Parts...>> copy_;
};

}  // namespace sluice::fluid
