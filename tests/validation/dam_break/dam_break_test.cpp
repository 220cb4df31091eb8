#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>

#include "validation/support/curve.hpp"
#include "validation/support/scene_run.hpp"

namespace sluice::validation {
namespace {

constexpr double kG = 9.81;         // [m/s^2]
constexpr double kWidth = 0.05715;  // a [m]

const std::string kFolder = std::string(SLUICE_SOURCE) + "/tests/validation/dam_break/";

double front(const fluid::Snapshot& s) {
  double x = 0;
  for (std::size_t i = 0; i < s.density.size(); ++i) x = std::max(x, s.position[3 * i]);
  return x;
}

// Particles further than half a spacing behind a closed wall.
int lost(const fluid::Snapshot& s, const Scene& scene) {
  const double slack = 0.5 * scene.spacing();
  int count = 0;
  for (std::size_t i = 0; i < s.density.size(); ++i) {
    const double x = s.position[3 * i], y = s.position[3 * i + 1];
    count += !(x > -slack && x < scene.domain().max(0) + slack && y > -slack);
  }
  return count;
}

// Largest |Z - Z_ref| / Z_ref over the points of a reference before the front meets the far wall.
double front_error(const Curve& computed, const Curve& reference) {
  double largest = 0;
  for (std::size_t k = 0; k < reference.x.size(); ++k) {
    if (!computed.covers(reference.x[k]) || reference.y[k] > 5.2) continue;
    largest = std::max(largest, std::abs(computed.at(reference.x[k]) - reference.y[k]) / reference.y[k]);
  }
  return largest;
}

// The picture of the front over the experiments, beside the result.
void plot_front(const std::string& result, const std::string& picture) {
  const std::string command = "/usr/bin/python3 " + kFolder + "plot_front.py " + result + " " + picture;
  ASSERT_EQ(std::system(command.c_str()), 0) << command;
  EXPECT_TRUE(std::ifstream(picture).good());
}

// Column a x 2a, 40 particles wide, to t sqrt(2g/a) = 8 with impact on the far wall. References: J. C.
// Martin, W. J. Moyce, Phil. Trans. R. Soc. A 244, 1952, fig. 3; S. Koshizuka, Y. Oka, Nucl. Sci. Eng. 123,
// 1996.
TEST(DamBreak, KeepsParticlesAndEnergyAndFollowsTheExperiments) {
  SceneRun run("dam_break");
  const double to_T = std::sqrt(2.0 * kG / kWidth);
  ASSERT_GE(run.end_time() * to_T, 8.0 - 0.01);
  const auto energy = [&] {
    const fluid::Diagnostics d = run.solver().diagnostics();
    return d.kinetic + d.potential + d.elastic;
  };
  const double start = energy();
  double lowest = start, largest_rise = 0;
  Curve computed{{0.0}, {1.0}};
  std::ofstream csv(result_file("dam_break.csv"));
  csv << "# T=t*sqrt(2g/a),Z=x_front/a,energy/start\n0,1,1\n";
  while (run.next_step()) {
    largest_rise = std::max(largest_rise, energy() - lowest);
    lowest = std::min(lowest, energy());
    if (!run.is_output()) continue;
    const fluid::Snapshot s = run.solver().snapshot();
    ASSERT_EQ(lost(s, run.scene()), 0) << "particles behind the walls at " << run.time() << " s";
    computed.x.push_back(run.time() * to_T);
    computed.y.push_back(front(s) / kWidth);
    csv << computed.x.back() << ',' << computed.y.back() << ',' << energy() / start << '\n';
    EXPECT_LT(computed.y.back(), 1.01 + 2.0 * computed.x.back()) << "ahead of Ritter's front";
  }
  EXPECT_LE(largest_rise, 1e-3 * start);
  csv.close();

  for (const char* name :
       {"martin_moyce_1952_n2eq2_a1.125in", "martin_moyce_1952_n2eq2_a2.25in", "koshizuka_oka_1996_exp"}) {
    const double error = front_error(computed, read_curve(kFolder + name + ".csv"));
    std::printf("dam break: front against %s: largest error %.1f %%\n", name, 100 * error);
    EXPECT_LT(error, 0.3)
        << name;  // no bed friction here, and the farthest particle runs ahead of the tongue
  }
  std::printf("dam break: largest rise of energy %.4f %% of its start, %.1f %% left\n",
              100 * largest_rise / start, 100 * energy() / start);
  plot_front(result_file("dam_break.csv"), result_file("dam_break_front.png"));
}

}  // namespace
}  // namespace sluice::validation
