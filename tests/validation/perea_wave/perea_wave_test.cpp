#include "validation/perea_wave/perea_wave.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>

#include "validation/support/files.hpp"
#include "validation/support/results.hpp"

namespace sluice::validation {
namespace {

void write(const PereaWaveRun& run, const std::string& file) {
  std::ofstream csv(file);
  csv << "# t [s], x [m], y [m], speed [m/s]\n";
  for (std::size_t k = 0; k < run.times.size(); ++k) {
    const fluid::Snapshot& state = run.states[k];
    for (std::size_t i = 0; i < state.density.size(); ++i)
      csv << run.times[k] << ',' << state.position[3 * i] << ',' << state.position[3 * i + 1] << ','
          << std::hypot(state.velocity[3 * i], state.velocity[3 * i + 1]) << '\n';
  }
}

// The wave as it breaks, beside the result.
void plot(const PereaWaveRun& run) {
  const std::string result = result_file("perea_wave.csv"), picture = result_file("perea_wave.png");
  write(run, result);
  const std::string command =
      "/usr/bin/python3 " + case_file("perea_wave/plot_wave.py").string() + " " + result + " " + picture;
  ASSERT_EQ(std::system(command.c_str()), 0) << command;
  EXPECT_TRUE(std::ifstream(picture).good());
}

TEST(PereaWave, KeepsItsMomentumAndLosesEnergyAsItBreaks) {
  const PereaWaveRun run = run_perea_wave(30, {}, 1);
  const Outcome& found = run.outcome;
  EXPECT_LE(found.figure("momentum along the tank"), 1);
  EXPECT_LE(found.figure("energy"), 0.1);
  EXPECT_LT(found.figure("energy left"), 95);
  EXPECT_EQ(found.figure("particles lost"), 0);
  ASSERT_EQ(run.times.size(), 4u);
  plot(run);
}

}  // namespace
}  // namespace sluice::validation
