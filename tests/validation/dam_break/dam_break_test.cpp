#include "validation/dam_break/dam_break.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "validation/support/files.hpp"
#include "validation/support/results.hpp"

namespace sluice::validation {
namespace {

// The picture of the front over the experiments, beside the result.
void plot_front(const std::string& result, const std::string& picture) {
  const std::string command =
      "/usr/bin/python3 " + case_file("dam_break/plot_front.py").string() + " " + result + " " + picture;
  ASSERT_EQ(std::system(command.c_str()), 0) << command;
  EXPECT_TRUE(std::ifstream(picture).good());
}

// Largest |Z - Z_ref| / Z_ref over the points of a reference that the computed front covers.
double front_error(const Curve& computed, const Curve& reference) {
  double largest = 0;
  for (std::size_t k = 0; k < reference.x.size(); ++k)
    if (computed.covers(reference.x[k]))
      largest = std::max(largest, std::abs(computed.at(reference.x[k]) - reference.y[k]) / reference.y[k]);
  return largest;
}

// Column a x 2a, 40 particles wide, to t sqrt(2g/a) = 8 with impact on the far wall.
TEST(DamBreak, KeepsParticlesAndEnergyAndFollowsTheExperiments) {
  const DamBreakRun run = run_dam_break(40, {}, 1);
  EXPECT_GE(run.energy.x.back(), 8.0 - 0.01);
  EXPECT_EQ(run.outcome.figure("particles lost"), 0);
  EXPECT_LE(run.outcome.figure("energy"), 0.1);
  for (std::size_t k = 0; k < run.front.x.size(); ++k)
    EXPECT_LT(run.front.y[k], 1.01 + 2.0 * run.front.x[k]) << "ahead of Ritter's front";
  for (const Experiment& experiment : dam_break_experiments()) {
    const double error = front_error(run.front, experiment.front);
    std::printf("dam break: front against %s: largest error %.1f %%\n", experiment.name.c_str(), 100 * error);
    EXPECT_LT(error, 0.3) << experiment.name;  // no bed friction here
  }

  std::ofstream csv(result_file("dam_break.csv"));
  csv << "# T=t*sqrt(2g/a),Z=x_front/a\n";
  for (std::size_t k = 0; k < run.front.x.size(); ++k) csv << run.front.x[k] << ',' << run.front.y[k] << '\n';
  csv.close();
  plot_front(result_file("dam_break.csv"), result_file("dam_break_front.png"));
}

}  // namespace
}  // namespace sluice::validation
