#include "fluid/parallel.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>
#include <tbb/task_arena.h>

namespace sluice::fluid {

namespace {
using Range = tbb::blocked_range<std::size_t>;
}  // namespace

struct Parallel::Arena {
  int threads;
  tbb::task_arena arena;
};

Parallel::Parallel(int threads) : arena_(new Arena{threads, tbb::task_arena(threads)}) {}
Parallel::~Parallel() = default;

void Parallel::for_blocks(std::size_t count, std::size_t grain, const Block& block) const {
  if (arena_->threads == 1 || count <= grain) {
    block(0, count);
    return;
  }
  arena_->arena.execute(
      [&] { tbb::parallel_for(Range(0, count, grain), [&](const Range& r) { block(r.begin(), r.end()); }); });
}

double Parallel::max_of_blocks(std::size_t count, const BlockValue& block) const {
  if (arena_->threads == 1 || count <= kGrain) return block(0, count);
  return arena_->arena.execute([&] {
    return tbb::parallel_reduce(
        Range(0, count, kGrain), 0.0,
        [&](const Range& r, double largest) { return larger(largest, block(r.begin(), r.end())); }, larger);
  });
}

}  // namespace sluice::fluid
