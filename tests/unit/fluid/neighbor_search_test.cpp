#include "fluid/neighbor_search.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <limits>

#include "tests/unit/fluid/clouds.hpp"
#include "tests/unit/fluid/search_oracle.hpp"

namespace sluice::fluid {
namespace {

constexpr double kSupport = 0.3, kSkin = 0.05, kReach = kSupport + kSkin;

// Fluid, walls and one body, all at random places of the cube [-1, 1]^Dim.
template <int Dim>
struct Cloud {
  Cloud(int fluid_count, int boundary_count, std::mt19937_64& random)
      : fluid(particles_at(places(fluid_count, random))),
        boundary(setup(boundary_count, random)),
        search(kSupport, kSkin) {
    boundary.move({&body, 1});
  }

  static std::vector<Vec<Dim>> places(int count, std::mt19937_64& random) {
    std::vector<Vec<Dim>> x;
    for (int k = 0; k < count; ++k) x.push_back(random_vector<Dim>(random));
    return x;
  }
  static Setup setup(int count, std::mt19937_64& random) {
    Setup s;
    s.walls = boundary_at(places(count, random));
    s.bodies.push_back(boundary_at(places(count, random)));
    return s;
  }

  void update() { search.update(fluid, boundary, Parallel(1)); }
  void move_fluid(double distance, std::mt19937_64& random) {
    for (Node<Dim>& node : fluid.node) node.x += distance * random_direction<Dim>(random);
  }
  void move_body(double distance) {
    body.position.x() += distance;
    boundary.move({&body, 1});
  }

  Particles<Dim> fluid;
  Kinematics body;
  BoundaryParticles<Dim> boundary;
  NeighborSearch<Dim> search;
};

template <int Dim>
void check_random_cloud() {
  const auto seed = *rc::gen::arbitrary<std::uint64_t>();
  std::mt19937_64 random(seed);
  Cloud<Dim> cloud(*rc::gen::inRange(1, 300), *rc::gen::inRange(0, 100), random);
  cloud.update();
  RC_ASSERT(cloud.search.rebuilds() == 1u);
  RC_ASSERT(matches_all_pairs(cloud.search, cloud.fluid, cloud.boundary, kReach - 1e-12, kReach + 1e-12));
  RC_ASSERT(is_transpose(cloud.search, cloud.fluid, cloud.boundary));
  // Moved by anything from nothing to twice the skin, in three steps.
  for (int k = 0; k < 3; ++k) {
    cloud.move_fluid(*rc::gen::inRange(0, 100) * 0.01 * kSkin, random);
    cloud.move_body(*rc::gen::inRange(0, 200) * 0.01 * kSkin);
    cloud.update();
    const double anything = std::numeric_limits<double>::infinity();
    RC_ASSERT(matches_all_pairs(cloud.search, cloud.fluid, cloud.boundary, kSupport, anything));
    RC_ASSERT(is_transpose(cloud.search, cloud.fluid, cloud.boundary));
  }
}

RC_GTEST_PROP(NeighborSearch, MatchesAllPairsInThePlane, ()) {
  check_random_cloud<2>();
}
RC_GTEST_PROP(NeighborSearch, MatchesAllPairsInSpace, ()) {
  check_random_cloud<3>();
}

TEST(NeighborSearch, KeepsItsListsUntilASkinMayHaveBeenCrossed) {
  std::mt19937_64 random(21);
  Cloud<2> cloud(100, 30, random);
  cloud.update();
  cloud.move_fluid(0.49 * kSkin, random);
  cloud.update();
  EXPECT_EQ(cloud.search.rebuilds(), 1u);
  cloud.move_body(0.50 * kSkin);
  cloud.update();
  EXPECT_EQ(cloud.search.rebuilds(), 1u);
  cloud.move_body(0.02 * kSkin);  // now 0.49 + 0.52 of the skin
  cloud.update();
  EXPECT_EQ(cloud.search.rebuilds(), 2u);
  EXPECT_TRUE(matches_all_pairs(cloud.search, cloud.fluid, cloud.boundary, kReach, kReach));
}

TEST(NeighborSearch, FindsParticlesThatMeetHeadOn) {
  Particles<2> fluid = particles_at<2>({Vec<2>(0, 0), Vec<2>(kReach + 1e-9, 0)});
  const BoundaryParticles<2> none((fluid::Setup()));
  NeighborSearch<2> search(kSupport, kSkin);
  search.update(fluid, none, Parallel(1));
  EXPECT_TRUE(search.fluid_near_fluid(0).empty());
  for (int k = 0; k < 2; ++k) fluid.node[k].x.x() += (fluid.node[k].x.x() < 0.1 ? 0.51 : -0.51) * kSkin;
  search.update(fluid, none, Parallel(1));
  EXPECT_EQ(search.fluid_near_fluid(0).size(), 1u);
}

// A permutation must carry everything a particle owns, and the identity with it.
TEST(NeighborSearch, SortingKeepsParticlesWhole) {
  std::mt19937_64 random(22);
  Cloud<3> cloud(500, 0, random);
  std::vector<Vec<3>> first;
  for (std::size_t i = 0; i < cloud.fluid.size(); ++i) {
    first.push_back(cloud.fluid.node[i].x);
    cloud.fluid.mass[i] = cloud.fluid.density_rate[i] = cloud.fluid.node[i].volume = static_cast<double>(i);
    cloud.fluid.acceleration[i] = cloud.fluid.node[i].v = Vec<3>::Constant(static_cast<double>(i));
  }
  cloud.update();
  std::vector<bool> seen(cloud.fluid.size(), false);
  bool reordered = false;
  for (std::size_t k = 0; k < cloud.fluid.size(); ++k) {
    const std::uint32_t i = cloud.fluid.id[k];
    ASSERT_LT(i, seen.size());
    EXPECT_FALSE(seen[i]);
    seen[i] = true;
    reordered = reordered || i != k;
    EXPECT_EQ(cloud.fluid.node[k].x, first[i]);
    EXPECT_EQ(cloud.fluid.node[k].v, Vec<3>::Constant(i));
    EXPECT_EQ(cloud.fluid.node[k].volume, i);
    EXPECT_EQ(cloud.fluid.mass[k], i);
    EXPECT_EQ(cloud.fluid.density_rate[k], i);
    EXPECT_EQ(cloud.fluid.acceleration[k], Vec<3>::Constant(i));
  }
  EXPECT_TRUE(reordered);
}

TEST(NeighborSearch, CoincidentParticlesAreNeighbors) {
  const std::vector<Vec<3>> places(20, Vec<3>(0.1, 0.2, 0.3));
  Particles<3> fluid = particles_at(places);
  fluid::Setup setup;
  setup.walls = boundary_at<3>({places.front()});
  const BoundaryParticles<3> boundary(setup);
  NeighborSearch<3> search(kSupport, kSkin);
  search.update(fluid, boundary, Parallel(1));
  EXPECT_TRUE(matches_all_pairs(search, fluid, boundary, kSupport, kReach));
  EXPECT_EQ(search.fluid_near_fluid(7).size(), 19u);
  EXPECT_EQ(search.fluid_near_active(0).size(), 20u);
}

TEST(NeighborSearch, OneParticleFarAwayHarmsNobody) {
  for (const double far : {1e3, 1e8, 1e15, 1e200}) {
    SCOPED_TRACE(far);
    std::mt19937_64 random(23);
    Cloud<3> cloud(200, 40, random);
    cloud.fluid.node[17].x = Vec<3>(-far, far, far);
    cloud.update();
    EXPECT_TRUE(matches_all_pairs(cloud.search, cloud.fluid, cloud.boundary, kReach, kReach));
    EXPECT_TRUE(is_transpose(cloud.search, cloud.fluid, cloud.boundary));
  }
}

// The stability guard reports a broken state, which it can only do if the step comes to its end.
TEST(NeighborSearch, SurvivesPositionsThatAreNoNumbers) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  for (const double bad : {nan, inf, -inf})
    for (const std::size_t which : {0, 17, 99}) {
      SCOPED_TRACE(testing::Message() << bad << " in particle " << which);
      std::mt19937_64 random(24);
      Cloud<2> cloud(100, 40, random);
      cloud.update();
      cloud.move_fluid(2.0 * kSkin, random);  // so that all lists are built anew
      cloud.fluid.node[which].x.y() = bad;
      cloud.update();
      EXPECT_EQ(cloud.search.rebuilds(), 2u);
      EXPECT_TRUE(is_transpose(cloud.search, cloud.fluid, cloud.boundary));
      for (std::size_t i = 0; i < 100; ++i)
        for (const std::uint32_t j : cloud.search.fluid_near_fluid(i)) ASSERT_LT(j, 100u);
    }
}

}  // namespace
}  // namespace sluice::fluid
