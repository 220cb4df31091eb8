#include <gtest/gtest.h>

#include "fluid/neighbor_search.hpp"
#include "tests/unit/fluid/plates.hpp"
#include "tests/unit/fluid/search_oracle.hpp"

namespace sluice::fluid {
namespace {

constexpr double kSupport = 0.15, kSkin = 0.02;

// Fluid all around a plate in random poses: the lists against all pairs, filtered by the plate's rules.
template <int Dim>
void check_search_around_plate(const Eigen::Vector3d& half_size, std::size_t particles) {
  std::mt19937_64 random(41);
  const Parallel serial(1);
  for (int k = 0; k < 20; ++k) {
    SCOPED_TRACE(k);
    PlateCase<Dim> plate_case(half_size);
    plate_case.move_to(random_pose<Dim>(random));
    const BoundaryParticles<Dim>& boundary = plate_case.boundary;
    std::vector<Vec<Dim>> places;
    while (places.size() < particles) {
      const Vec<Dim> x = narrow<Dim>(plate_case.pose.position) + 0.6 * random_vector<Dim>(random);
      if (plate_case.distance(x) > 0.0) places.push_back(x);
    }
    Particles<Dim> fluid = particles_at(places);
    NeighborSearch<Dim> search(kSupport, kSkin);
    search.update(fluid, boundary, serial);
    std::size_t cut = 0, hidden = 0;
    const auto open = [&](const Vec<Dim>& x, const Vec<Dim>& y) {
      const bool blocked = separates(plate_case.plate(), x, y);
      cut += blocked ? 1 : 0;
      return !blocked;
    };
    const auto visible = [&](std::uint32_t w, const Vec<Dim>& x) {
      const bool seen = sees_face(plate_case.plate(), static_cast<std::size_t>(boundary.face(w)), x);
      hidden += seen ? 0 : 1;
      return seen;
    };
    const double reach = kSupport + kSkin;
    EXPECT_TRUE(matches_all_pairs(search, fluid, boundary, reach, reach, open, visible));
    EXPECT_TRUE(is_transpose(search, fluid, boundary));
    EXPECT_GT(cut, 0u);
    EXPECT_GT(hidden, 0u);
  }
}

TEST(PlateSearch, MatchesAllPairsInThePlane) {
  check_search_around_plate<2>({0.03, 0.4, 0}, 300);
}
TEST(PlateSearch, MatchesAllPairsInSpace) {
  check_search_around_plate<3>({0.03, 0.3, 0.3}, 400);
}

// Two layers of water on both sides of a gate, as in the rising gate: nothing passes through it.
TEST(PlateSearch, SidesOfAGateDoNotMeet) {
  PlateCase<2> gate({0.03, 0.5, 0});
  std::vector<Vec<2>> places;
  for (int b = -8; b < 8; ++b)
    for (const double x : {-0.105, -0.055, 0.055, 0.105}) places.emplace_back(x, 0.05 * (b + 0.5));
  Particles<2> fluid = particles_at(places);
  NeighborSearch<2> search(kSupport, kSkin);
  search.update(fluid, gate.boundary, Parallel(1));
  std::size_t pairs = 0, contacts = 0;
  for (std::size_t i = 0; i < fluid.size(); ++i) {
    const double side = fluid.node[i].x.x();
    for (const std::uint32_t j : search.fluid_near_fluid(i)) EXPECT_GT(side * fluid.node[j].x.x(), 0.0);
    for (const std::uint32_t w : search.boundary_near_fluid(i)) {
      const Vec<2>& normal = gate.plate().faces[static_cast<std::size_t>(gate.boundary.face(w))].normal;
      EXPECT_GT(side * normal.x(), 0.0);
    }
    pairs += search.fluid_near_fluid(i).size();
    contacts += search.boundary_near_fluid(i).size();
  }
  EXPECT_GT(pairs, 4 * fluid.size());
  EXPECT_GT(contacts, 2 * fluid.size());
}

}  // namespace
}  // namespace sluice::fluid
