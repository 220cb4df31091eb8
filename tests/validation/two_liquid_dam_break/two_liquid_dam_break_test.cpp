#include "validation/two_liquid_dam_break/two_liquid_dam_break.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "validation/support/files.hpp"
#include "validation/support/results.hpp"

namespace sluice::validation {
namespace {

// The picture of the fronts over the experiments, beside the result.
void plot_fronts(const TwoLiquidDamBreakRun& run) {
  const std::string result = result_file("two_liquid_dam_break.csv"),
                    picture = result_file("two_liquid_dam_break_fronts.png");
  std::ofstream csv(result);
  csv << "# T=t*sqrt(2g/a),light,heavy: way of the front over a\n";
  for (std::size_t k = 0; k < run.light.x.size(); ++k)
    csv << run.light.x[k] << ',' << run.light.y[k] << ',' << run.heavy.y[k] << '\n';
  csv.close();
  const std::string command = "/usr/bin/python3 " +
                              case_file("two_liquid_dam_break/plot_fronts.py").string() + " " + result + " " +
                              picture;
  ASSERT_EQ(std::system(command.c_str()), 0) << command;
  EXPECT_TRUE(std::ifstream(picture).good());
}

TEST(TwoLiquidDamBreak, ColumnsFallAlikeAndTheHeavyOneEndsBelow) {
  const TwoLiquidDamBreakRun run = run_two_liquid_dam_break(10, {}, 1);
  EXPECT_EQ(run.outcome.figure("particles lost"), 0);
  EXPECT_LE(run.outcome.figure("fronts apart"), 8);
  EXPECT_LE(run.outcome.figure("energy"), 0.1);
  EXPECT_LE(run.outcome.error, 0.2);
  EXPECT_GT(run.outcome.figure("light above heavy at the end"), 10);
  EXPECT_GT(run.light.x.back(), 3);
  plot_fronts(run);
}

}  // namespace
}  // namespace sluice::validation
