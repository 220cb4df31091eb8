#include "benchmark/peak.hpp"

#include <algorithm>
#include <chrono>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "benchmark/peak.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace sluice::benchmark::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// Returns the operations done; `sink` keeps the loop from being dropped.
double multiply_add(long rounds, double& sink) {
  const hn::ScalableTag<double> d;
  using V = hn::Vec<decltype(d)>;
  constexpr int kChains = 12;  // more than latency times throughput of any processor so far
  V a[kChains];
  for (int k = 0; k < kChains; ++k) a[k] = hn::Set(d, 1.0 + k);
  const V factor = hn::Set(d, 0.999999), summand = hn::Set(d, 1e-7);
  for (long round = 0; round < rounds; ++round) {
    HWY_UNROLL(12)
    for (int k = 0; k < kChains; ++k) a[k] = hn::MulAdd(a[k], factor, summand);
  }
  for (int k = 1; k < kChains; ++k) a[0] = a[0] + a[k];
  sink = hn::GetLane(hn::SumOfLanes(d, a[0]));
  return 2.0 * kChains * static_cast<double>(rounds) * static_cast<double>(hn::Lanes(d));
}

}  // namespace sluice::benchmark::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sluice::benchmark {

HWY_EXPORT(multiply_add);

double measure_peak() {
  using Clock = std::chrono::steady_clock;
  double best = 0;
  volatile double kept = 0;
  for (int repeat = 0; repeat < 10; ++repeat) {
    double sink = 0;
    const auto start = Clock::now();
    const double operations = HWY_DYNAMIC_DISPATCH(multiply_add)(2'000'000, sink);
    best = std::max(best, operations / std::chrono::duration<double>(Clock::now() - start).count());
    kept = sink;
  }
  static_cast<void>(kept);
  return best;
}

}  // namespace sluice::benchmark
#endif
