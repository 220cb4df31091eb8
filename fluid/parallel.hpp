#pragma once

#include <cstddef>
#include <functional>
#include <memory>

#include "fluid/types.hpp"

namespace sluice::fluid {

// Loops over index ranges on a fixed number of threads. Every index is written by one thread and results
// never depend on which: gather loops only. Sums are left to the caller, in a fixed order.
class Parallel {
 public:
  explicit Parallel(int threads);
  ~Parallel();
  Parallel(const Parallel&) = delete;
  Parallel& operator=(const Parallel&) = delete;

  // Particles a task: about 20 microseconds of sweep, far above the cost of handing a task out.
  static constexpr std::size_t kGrain = 256;

  // Calls body(i) for i in 0 .. count-1, `grain` of them a task.
  template <typename Body>
  void for_each(std::size_t count, const Body& body, std::size_t grain = kGrain) const {
    for_blocks(count, grain, [&body](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) body(i);
    });
  }

  // Largest value(i), at least 0. The maximum does not depend on the order; not-a-number is the largest.
  template <typename Value>
  [[nodiscard]] double max(std::size_t count, const Value& value) const {
    return max_of_blocks(count, [&value](std::size_t begin, std::size_t end) {
      double largest = 0;
      for (std::size_t i = begin; i < end; ++i) largest = larger(largest, value(i));
      return largest;
    });
  }

 private:
  using Block = std::function<void(std::size_t, std::size_t)>;
  using BlockValue = std::function<double(std::size_t, std::size_t)>;
  void for_blocks(std::size_t count, std::size_t grain, const Block& block) const;
  [[nodiscard]] double max_of_blocks(std::size_t count, const BlockValue& block) const;

  struct Arena;
  std::unique_ptr<Arena> arena_;
};

}  // namespace sluice::fluid
