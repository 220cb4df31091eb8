#include "validation/lock_exchange/lock_exchange.hpp"

#include <gtest/gtest.h>

namespace sluice::validation {
namespace {

TEST(LockExchange, FrontsRunAsTheoryHasThem) {
  const Outcome found = lock_exchange().run(10, {}, 1);
  EXPECT_LE(found.figure("light front"), 20);  // measured 15.7
  EXPECT_GT(found.figure("Froude number of the heavy front"),
            found.figure("Froude number of the light front"));
  EXPECT_LE(found.figure("energy"), 0.1);
}

}  // namespace
}  // namespace sluice::validation
