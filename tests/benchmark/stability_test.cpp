#include "benchmark/stability.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <fstream>

#include "benchmark/kernel_sums.hpp"
#include "benchmark/random.hpp"
#include "fluid/kernel.hpp"

namespace sluice::benchmark {
namespace {

using testing::HasSubstr;
using testing::Not;

StabilityTable table(double value) {
  return {.name = "tank",
          .title = "A tank",
          .items = "depth",
          .columns = {{"speed", "m/s"}},
          .rows = {{"shallow", {0.25}, "says \"no\""}},
          .figures = {{"rise", "%", value, 1}, {"scenes", "", 3}}};
}

TEST(StabilityTable, MarksWhatMissesItsBound) {
  EXPECT_FALSE(table(0.5).any_missed());
  EXPECT_THAT(to_text(table(0.5)), Not(HasSubstr("MISSED")));
  EXPECT_TRUE(table(2).any_missed());
  EXPECT_THAT(to_text(table(2)), HasSubstr("2 %; at most 1: MISSED"));
  EXPECT_THAT(to_text(table(2)), HasSubstr("speed [m/s]"));
}

TEST(StabilityTable, HasALineAValueAndAFigure) {
  const std::string csv = to_csv({table(2)});
  EXPECT_THAT(csv, HasSubstr("tank,\"shallow\",\"speed\",\"m/s\",0.25,,,\"says \"\"no\"\"\"\n"));
  EXPECT_THAT(csv, HasSubstr("tank,,\"rise\",\"%\",2,1,1,\n"));
  EXPECT_THAT(csv, HasSubstr("tank,,\"scenes\",\"\",3,,,\n"));
}

TEST(Readme, SaysWhatEveryCheckStates) {
  std::ifstream file(SLUICE_SOURCE "/tests/benchmark/README.md");
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  for (const StabilityCheck& check : all_checks()) EXPECT_THAT(text, HasSubstr("\n| `" + check.name + "` |"));
}

// The tent of support 1 on each axis: on a lattice of spacing 1 it sums to one everywhere.
struct Tent {
  [[nodiscard]] double support() const { return std::sqrt(2.0); }
  [[nodiscard]] double value(const fluid::Vec<2>& x) const {
    return std::max(0.0, 1 - std::abs(x[0])) * std::max(0.0, 1 - std::abs(x[1]));
  }
};

TEST(KernelSums, AreThoseOfTheTent) {
  const KernelSums sums = kernel_sums_of(Tent{});
  EXPECT_NEAR(sums.line_M, 0, 1e-5);
  EXPECT_NEAR(sums.plane_M, 0, 1e-12);
  EXPECT_NEAR(sums.plane_N, 0, 1e-9);
  EXPECT_NEAR(sums.slope_at_zero, 1, 1e-5);
}

TEST(KernelSums, FallWithTheSmoothingLength) {
  const KernelSums narrow = kernel_sums_of(fluid::WendlandC2<2>(1));
  const KernelSums wide = kernel_sums_of(fluid::WendlandC2<2>(2));
  EXPECT_LT(wide.line_M, narrow.line_M / 10);
  EXPECT_LT(wide.plane_M, narrow.plane_M / 10);
  EXPECT_LT(wide.plane_N, narrow.plane_N / 10);
}

TEST(Random, IsTheEngineMappedToAnInterval) {
  Random random(1);
  std::mt19937_64 engine(1);
  const double share = std::ldexp(static_cast<double>(engine() >> 11), -53);
  EXPECT_EQ(random.uniform(2, 4), 2 + 2 * share);
  for (int k = 0; k < 1000; ++k) {
    const int n = random.integer(3, 5);
    EXPECT_TRUE(n >= 3 && n <= 5);
  }
}

}  // namespace
}  // namespace sluice::benchmark
