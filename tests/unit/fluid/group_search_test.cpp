#include "fluid/group_search.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <set>

#include "fluid/neighbor_search.hpp"
#include "tests/unit/fluid/clouds.hpp"
#include "tests/unit/fluid/search_oracle.hpp"

namespace sluice::fluid {
namespace {

constexpr double kSupport = 0.3, kSkin = 0.05, kReach = kSupport + kSkin;

template <int Dim>
std::vector<Vec<Dim>> places(int count, std::mt19937_64& random) {
  std::vector<Vec<Dim>> x;
  for (int k = 0; k < count; ++k) x.push_back(random_vector<Dim>(random));
  return x;
}

// Whether a list has, once each, the items that are within reach of any particle of a group, and no others.
template <int Dim>
bool has_all_near(const GroupList& list, const std::vector<Node<Dim>>& particles, std::size_t count,
                  const std::vector<Node<Dim>>& items) {
  if (list.size() != group_count(count)) return false;
  for (std::size_t group = 0; group < list.size(); ++group) {
    std::set<std::uint32_t> near;
    for (std::size_t i = group * kGroup; i < std::min(count, (group + 1) * kGroup); ++i)
      for (std::uint32_t k = 0; k < items.size(); ++k)
        if ((items[k].x - particles[i].x).norm() < kReach) near.insert(k);
    std::vector<std::uint32_t> listed;
    list.of(group).for_each([&](std::size_t n, std::uint32_t item) {
      if (n == listed.size()) listed.push_back(item);
    });
    if (listed.size() != near.size() || list.of(group).count != near.size() ||
        std::set<std::uint32_t>(listed.begin(), listed.end()) != near)
      return false;
  }
  return true;
}

// Fluid, walls and a body at random places of the cube [-1, 1]^Dim, periodic in x or not.
template <int Dim>
void check_random_cloud() {
  std::mt19937_64 random(*rc::gen::arbitrary<std::uint64_t>());
  Particles<Dim> fluid = particles_at(places<Dim>(*rc::gen::inRange(1, 400), random));
  Setup setup;
  setup.walls = boundary_at(places<Dim>(*rc::gen::inRange(0, 200), random));
  setup.bodies.push_back(boundary_at(places<Dim>(*rc::gen::inRange(1, 100), random)));
  BoundaryParticles<Dim> boundary(setup);
  const Kinematics at_rest;
  boundary.move({&at_rest, 1});
  Period period;
  if (*rc::gen::arbitrary<bool>()) {
    period.lower = {-1.0, -1.0, -1.0};
    period.length = {2.0, 0.0, 0.0};
  }
  NeighborSearch<Dim> search(kSupport, kSkin, period, {.singles = true, .groups = true, .cell = 0.3});
  search.update(fluid, boundary, Parallel(2));
  const GroupSearch<Dim>& groups = search.groups();
  RC_ASSERT(has_all_near<Dim>(groups.fluid_near_fluid(), fluid.node, fluid.size(), fluid.node));
  RC_ASSERT(has_all_near<Dim>(groups.boundary_near_fluid(), fluid.node, fluid.size(), boundary.node()));
  RC_ASSERT(has_all_near<Dim>(groups.fluid_near_boundary(), boundary.node(), boundary.size(), fluid.node));
}

RC_GTEST_PROP(GroupSearch, HasAllThatIsNearInThePlane, ()) {
  check_random_cloud<2>();
}
RC_GTEST_PROP(GroupSearch, HasAllThatIsNearInSpace, ()) {
  check_random_cloud<3>();
}

TEST(Members, KeepGroupsApart) {
  std::vector<Members> all;
  add_item(17, 0, all);
  add_item(20, 0, all);
  ASSERT_EQ(all.size(), 1u);  // both of group 2
  EXPECT_EQ(all[0].first(), 16u);
  EXPECT_EQ(all[0].bits(), 0b10010u);
  add_item(19, 0, all);  // one that comes before is one of its own
  ASSERT_EQ(all.size(), 2u);
  add_item(21, 2, all);  // and so is one of the next list
  ASSERT_EQ(all.size(), 3u);
  EXPECT_EQ(all[2].count(), 1u);
  const auto last = static_cast<std::uint32_t>(kMostItems - 1);
  add_item(last, 3, all);
  EXPECT_EQ(all[3].first() + 7, last);
}

}  // namespace
}  // namespace sluice::fluid
