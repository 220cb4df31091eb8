#include "validation/sluice_gate/sluice_gate.hpp"

#include <gtest/gtest.h>

namespace sluice::validation {
namespace {

// Half of what is stated of a/10, at half the resolution.
TEST(SluiceGate, LetsThroughWhatTheTextbookSays) {
  const Outcome outcome = sluice_gate().run(5, {"duration=4"}, 1);
  EXPECT_LE(outcome.figure("from potential theory"), 8);
  EXPECT_LE(outcome.figure("from measurements"), 5);
  EXPECT_LE(outcome.figure("contraction"), 8);
  EXPECT_LE(outcome.figure("depth in front"), 2);
}

}  // namespace
}  // namespace sluice::validation
