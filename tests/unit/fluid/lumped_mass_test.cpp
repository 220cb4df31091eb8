#include "fluid/lumped_mass.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "tests/unit/fluid/clouds.hpp"
#include "tests/unit/fluid/setups.hpp"

namespace sluice::fluid {
namespace {

// Disordered water, with or without a tank around it, and the fits of its particles.
template <int Dim>
struct Water {
  Water(double jitter, bool in_tank) : scene(Dim, 0.1, 9.81, 20.0) {
    std::mt19937_64 random(11);
    for (const Vec<Dim>& x : jittered_lattice<Dim>(kCells, 0.1, jitter, random))
      scene.add_particle(widen<Dim>(x), Eigen::Vector3d::Zero(), 0.0);
    const double edge = 0.1 * kCells;
    // Walls above too: no free surface.
    if (in_tank)
      scene.setup.walls = sample_walls({{0, 0, 0}, {edge, edge, edge}, {true, true, true, true, true, true}},
                                       0.1, scene.support(), Dim);
  }

  // Lumped over physical mass.
  [[nodiscard]] std::vector<double> ratios() const {
    const Model<Dim> model(scene.setup);
    const Parallel parallel(1);
    const BoundaryParticles<Dim> boundary(scene.setup);
    NeighborSearch<Dim> search(model.kernel.support(), 0.1 * model.kernel.support());
    Particles<Dim> fluid;
    const std::size_t n = scene.setup.fluid.position.size();
    fluid.acceleration.resize(n);
    fluid.density_rate.resize(n);
    fluid.id.resize(n);
    std::iota(fluid.id.begin(), fluid.id.end(), 0u);
    for (std::size_t i = 0; i < n; ++i) {
      fluid.mass.push_back(1000.0 * scene.setup.fluid.volume);
      fluid.node.push_back(
          {narrow<Dim>(scene.setup.fluid.position[i]), Vec<Dim>::Zero(), scene.setup.fluid.volume, 1000.0});
    }
    search.update(fluid, boundary, parallel);
    for (std::size_t i = 0; i < n; ++i) fluid.fit[i] = fit_at(model, fluid, boundary, search, i);
    std::vector<double> all;
    for (std::size_t i = 0; i < n; ++i)
      all.push_back(lumped_mass<Dim>(model, fluid, boundary, search, i) / fluid.mass[i]);
    return all;
  }

  static constexpr int kCells = Dim == 2 ? 10 : 7;
  Scene scene;

 private:
  static Fit<Dim> fit_at(const Model<Dim>& model, const Particles<Dim>& fluid,
                         const BoundaryParticles<Dim>& boundary, const NeighborSearch<Dim>& search,
                         std::size_t i) {
    Moments<Dim> m;
    const Vec<Dim>& x = fluid.node[i].x;
    const auto add = [&](const Node<Dim>& j) {
      m.add(j.volume * model.kernel.value(Vec<Dim>(j.x - x)), j.x - x);
    };
    add(fluid.node[i]);
    for (const std::uint32_t j : search.fluid_near_fluid(i)) add(fluid.node[j]);
    for (const std::uint32_t w : search.boundary_near_fluid(i)) add(boundary.node()[w]);
    return fit(m, model.moment_floor);
  }
};

// CF (57): together they have the mass of the water.
template <int Dim>
void expect_whole_mass() {
  const std::vector<double> ratios = Water<Dim>(0.2, false).ratios();
  double sum = 0, largest = 0;
  for (const double r : ratios) {
    sum += r;
    largest = std::max(largest, std::abs(r - 1.0));
  }
  EXPECT_NEAR(sum / static_cast<double>(ratios.size()), 1.0, 1e-12);
  EXPECT_GT(largest, 0.05);  // but not one by one
}

TEST(LumpedMass, SumsToTheMassOfTheWater) {
  expect_whole_mass<2>();
  expect_whole_mass<3>();
}

// A lattice between walls is like an endless one: the physical mass.
TEST(LumpedMass, OfALatticeBetweenWallsIsThePhysical) {
  for (const double r : Water<2>(0.0, true).ratios()) EXPECT_NEAR(r, 1.0, 1e-12);
  for (const double r : Water<3>(0.0, true).ratios()) EXPECT_NEAR(r, 1.0, 1e-12);
}

}  // namespace
}  // namespace sluice::fluid
