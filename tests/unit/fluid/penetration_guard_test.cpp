#include <gtest/gtest.h>

#include "fluid/force_sweep.hpp"
#include "tests/unit/fluid/setups.hpp"

namespace sluice::fluid {
namespace {

constexpr double kSpacing = 0.1, kSoundSpeed = 20.0;

// Energy [J] of a particle that stands in a layer of boundary particles, as far from them as there is room,
// over m c0^2/2: what it must bring to pass.
template <int Dim>
double threshold() {
  Scene scene(Dim, kSpacing, 9.81, kSoundSpeed);
  scene.setup.fluid.position.emplace_back(0, 0, 0);
  scene.setup.fluid.volume = particle_volume(kSpacing, Dim);
  const Model<Dim> model(scene.setup);
  double energy = 0;
  for (int corner = 0; corner < (1 << (Dim - 1)); ++corner) {
    Vec<Dim> x = Vec<Dim>::Zero();
    for (int a = 0; a + 1 < Dim; ++a) x[a] = (corner >> a & 1) == 1 ? 0.5 * kSpacing : -0.5 * kSpacing;
    energy += guard_energy(model, x);
  }
  const double mass = scene.setup.liquid.density * scene.setup.fluid.volume;
  return energy / (0.5 * mass * kSoundSpeed * kSoundSpeed);
}

TEST(PenetrationGuard, HoldsWhatComesAtAQuarterOfTheSpeedOfSound) {
  EXPECT_GT(threshold<2>(), 0.25 * 0.25);
  EXPECT_GT(threshold<3>(), 0.25 * 0.25);
}

}  // namespace
}  // namespace sluice::fluid
