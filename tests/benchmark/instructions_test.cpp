#include "benchmark/instructions.hpp"

#include <gtest/gtest.h>

namespace sluice::benchmark {
namespace {

TEST(Instructions, AreReadFromTheLineThatHasThem) {
  EXPECT_EQ(counted_instructions("==12== I   refs:      1,234,567"), 1234567u);
  EXPECT_EQ(counted_instructions("==12== I refs:        89"), 89u);
  EXPECT_FALSE(counted_instructions("==12== Command: sluice-bench steps"));
  EXPECT_FALSE(counted_instructions("==12== I refs:"));
  EXPECT_FALSE(counted_instructions("I refs: 12"));
}

TEST(Instructions, EveryFeatureHasTwoScenesThatRun) {
  for (const Feature& feature : all_features())
    for (const bool with : {false, true})
      EXPECT_NO_THROW(run_steps({feature.name, with, 10, 3})) << feature.name;
}

}  // namespace
}  // namespace sluice::benchmark
