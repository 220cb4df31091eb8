// Compounds of thin plates: fluid in front of them has all its support filled and nothing of it twice, behind
// inward corners too, and nothing passes through.

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "fluid/boundary.hpp"
#include "fluid/kernel.hpp"
#include "fluid/neighbor_search.hpp"
#include "fluid/sampling.hpp"
#include "tests/unit/fluid/search_oracle.hpp"

namespace sluice::fluid {
namespace {

using Eigen::Vector3d;

constexpr double kDx = 0.1, kSmoothing = 0.145, kReach = 0.29;

PlacedShape box(const Vector3d& low, const Vector3d& high) {
  return {BoxShape{(high - low) / 2}, (low + high) / 2};
}

// The compound in the middle of fluid on the lattice that its plates fit, and what is near what.
template <int Dim>
class CompoundCase {
 public:
  // Fluid where it is outside the parts, within `half` of the origin along every axis.
  CompoundCase(const CompoundShape& shape, double half)
      : shape_(shape), boundary_(setup(shape)), search_(kReach, 0.0) {
    const Kinematics at_rest;
    boundary_.move({&at_rest, 1});
    const int n = static_cast<int>(std::lround(half / kDx));
    std::vector<Vec<Dim>> places;
    for (int c = Dim == 3 ? -n : 0; c < (Dim == 3 ? n : 1); ++c)
      for (int b = -n; b < n; ++b)
        for (int a = -n; a < n; ++a) {
          const Vector3d x = kDx * (Vector3d(a, b, c) + Vector3d::Constant(0.5));
          if (signed_distance(shape_, x, Dim) > 0) places.push_back(narrow<Dim>(x));
        }
    fluid_ = particles_at(places);
    search_.update(fluid_, boundary_, Parallel(1));
  }

  // Sum of V W at the fluid particle nearest to x, over that of the whole lattice.
  [[nodiscard]] double filled(const Vec<Dim>& x) const {
    const std::size_t i = nearest(x);
    const WendlandC2<Dim> kernel(kSmoothing);
    const double V = std::pow(kDx, Dim);
    double sum = V * kernel.at_zero();
    for (const std::uint32_t j : search_.fluid_near_fluid(i))
      sum += V * kernel.value(Vec<Dim>(fluid_.node[j].x - fluid_.node[i].x));
    for (const std::uint32_t w : search_.boundary_near_fluid(i))
      sum += boundary_.sampled_volume(w) * kernel.value(Vec<Dim>(boundary_.node()[w].x - fluid_.node[i].x));
    return sum / whole();
  }

  // Whether one of the particles near x and one near y see each other.
  [[nodiscard]] bool see_each_other(const Vec<Dim>& x, const Vec<Dim>& y) const {
    const auto near = search_.fluid_near_fluid(nearest(x));
    return std::find(near.begin(), near.end(), nearest(y)) != near.end();
  }

  [[nodiscard]] const BoundaryParticles<Dim>& boundary() const { return boundary_; }

 private:
  static Setup setup(const CompoundShape& shape) {
    Setup s;
    s.dimension = Dim;
    s.bodies.push_back(sample_body(shape, kDx, kReach, Dim));
    return s;
  }

  [[nodiscard]] std::size_t nearest(const Vec<Dim>& x) const {
    std::size_t best = 0;
    for (std::size_t i = 1; i < fluid_.size(); ++i)
      if ((fluid_.node[i].x - x).squaredNorm() < (fluid_.node[best].x - x).squaredNorm()) best = i;
    EXPECT_LT((fluid_.node[best].x - x).norm(), 0.5 * kDx);
    return best;
  }

  static double whole() {
    const WendlandC2<Dim> kernel(kSmoothing);
    double sum = 0;
    for (int c = Dim == 3 ? -3 : 0; c <= (Dim == 3 ? 3 : 0); ++c)
      for (int b = -3; b <= 3; ++b)
        for (int a = -3; a <= 3; ++a)
          sum += std::pow(kDx, Dim) * kernel.value(narrow<Dim>(kDx * Vector3d(a, b, c)));
    return sum;
  }

  CompoundShape shape_;
  BoundaryParticles<Dim> boundary_;
  NeighborSearch<Dim> search_;
  Particles<Dim> fluid_;
};

// An angle, open to the upper right: a stem and, on its right, a foot.
CompoundShape angle(double half_depth) {
  return {
      {box({0, 0, -half_depth}, {0.1, 0.9, half_depth}), box({0.1, 0, -half_depth}, {0.9, 0.1, half_depth})}};
}

TEST(CompoundPlates, OfAnAngleFillTheSupportOfWhatIsInItsCorner) {
  const CompoundCase<2> flow(angle(1), 1.2);
  for (const double y : {0.15, 0.25, 0.35, 0.55})
    for (const double x : {0.15, 0.25, 0.35, 0.55})
      EXPECT_NEAR(flow.filled({x, y}), 1.0, 1e-12) << x << ", " << y;
  EXPECT_NEAR(flow.filled({-0.05, 0.45}), 1.0, 1e-12);  // behind the stem
  EXPECT_NEAR(flow.filled({0.55, -0.15}), 1.0, 1e-12);  // below the foot
}

TEST(CompoundPlates, KeepTheSidesApart) {
  const CompoundCase<2> flow(angle(1), 1.2);
  EXPECT_FALSE(flow.see_each_other({-0.05, 0.45}, {0.15, 0.45}));
  EXPECT_FALSE(flow.see_each_other({0.55, -0.05}, {0.55, 0.15}));
  EXPECT_FALSE(flow.see_each_other({-0.05, 0.05}, {0.15, 0.15}));  // through the seam's end
  EXPECT_TRUE(flow.see_each_other({0.15, 0.15}, {0.25, 0.25}));
  EXPECT_TRUE(flow.see_each_other({-0.05, -0.05}, {0.05, -0.15}));  // around the outer corner
}

// Where the foot meets the stem's side, there is an inward corner above and one below it.
TEST(CompoundPlates, OfATeeFillBothCorners) {
  const CompoundShape tee{{box({0, -0.9, 0}, {0.1, 0.9, 0}), box({0.1, 0, 0}, {0.9, 0.1, 0})}};
  const CompoundCase<2> flow(tee, 1.2);
  for (const double x : {0.15, 0.25, 0.55})
    for (const double y : {-0.25, -0.15, -0.05, 0.15, 0.25, 0.35})
      EXPECT_NEAR(flow.filled({x, y}), 1.0, 1e-12) << x << ", " << y;
  for (const double y : {-0.35, -0.05, 0.05, 0.15, 0.35}) EXPECT_NEAR(flow.filled({-0.05, y}), 1.0, 1e-12);
  EXPECT_FALSE(flow.see_each_other({0.15, -0.05}, {0.15, 0.15}));
}

// Two pieces of one plate end to end are that plate, seam and all.
TEST(CompoundPlates, EndToEndAreOnePlate) {
  const CompoundShape two{{box({0, -0.9, 0}, {0.1, 0, 0}), box({0, 0, 0}, {0.1, 0.9, 0})}};
  const CompoundCase<2> flow(two, 1.2);
  for (const double y : {-0.25, -0.05, 0.05, 0.25})
    for (const double x : {-0.15, -0.05, 0.15, 0.25}) EXPECT_NEAR(flow.filled({x, y}), 1.0, 1e-12);
  EXPECT_FALSE(flow.see_each_other({-0.05, 0.05}, {0.15, -0.05}));
  const Boundary body = sample_body(two, kDx, kReach, 2);
  ASSERT_EQ(body.plates.size(), 2u);
  for (const auto& faces : body.plates)
    EXPECT_EQ(std::count_if(faces.begin(), faces.end(), [](const auto& face) { return face.is_covered; }), 1);
}

// A plate on a block, which has ordinary layers.
TEST(CompoundPlates, StandOnThickParts) {
  const CompoundShape fin{{box({-0.9, -0.9, 0}, {0.9, 0, 0}), box({0, 0, 0}, {0.1, 0.9, 0})}};
  const CompoundCase<2> flow(fin, 1.2);
  for (const double x : {-0.25, -0.15, -0.05, 0.15, 0.25})
    for (const double y : {0.05, 0.15, 0.25}) EXPECT_NEAR(flow.filled({x, y}), 1.0, 1e-12) << x << ", " << y;
  EXPECT_FALSE(flow.see_each_other({-0.05, 0.25}, {0.15, 0.25}));
  EXPECT_EQ(sample_body(fin, kDx, kReach, 2).plates.size(), 1u);
}

TEST(CompoundPlates, OfAnAngleInSpaceFillItsCorner) {
  const CompoundCase<3> flow(angle(0.9), 1.2);
  for (const double y : {0.15, 0.25, 0.45})
    for (const double x : {0.15, 0.25, 0.45}) EXPECT_NEAR(flow.filled({x, y, 0.05}), 1.0, 1e-12);
  EXPECT_NEAR(flow.filled({-0.05, 0.45, 0.05}), 1.0, 1e-12);
  EXPECT_FALSE(flow.see_each_other({-0.05, 0.45, 0.05}, {0.15, 0.45, 0.05}));
}

// Three plates of a box's corner: what is in it lacks nothing behind the point where they meet.
TEST(CompoundPlates, OfABoxFillItsCornerInSpace) {
  const CompoundShape corner{{box({0, 0.1, 0.1}, {0.1, 0.9, 0.9}), box({0, 0, 0.1}, {0.9, 0.1, 0.9}),
                              box({0, 0, 0}, {0.9, 0.9, 0.1})}};
  const CompoundCase<3> flow(corner, 1.2);
  for (const double x : {0.15, 0.25, 0.45})
    for (const double y : {0.15, 0.25})
      for (const double z : {0.15, 0.35}) EXPECT_NEAR(flow.filled({x, y, z}), 1.0, 1e-12);
}

// An arc of eight pieces that taper to its middle, a radial gate's skin. Where it is upright its pieces'
// layers fit the fluid's lattice on either side but for the seams, which open to one side and close to the
// other.
TEST(CompoundPlates, OfAnArcFillTheSupportOnBothSides) {
  const auto at = [](double radius, int k) {
    const double angle = 0.12 * (k - 4);
    return Eigen::Vector2d(radius * std::cos(angle) - 2, radius * std::sin(angle));
  };
  CompoundShape arc;
  for (int k = 0; k < 8; ++k)
    arc.parts.push_back({PolygonShape{{at(2, k), at(2.1, k), at(2.1, k + 1), at(2, k + 1)}}});
  const CompoundCase<2> flow(arc, 1.2);
  for (const double y : {-0.15, -0.05, 0.05, 0.15})
    for (const double x : {-0.25, -0.15, 0.15, 0.25})
      EXPECT_NEAR(flow.filled({x, y}), 1.0, 0.06) << x << ", " << y;
  EXPECT_FALSE(flow.see_each_other({-0.15, 0.05}, {0.15, 0.05}));
}

// A body turns as a whole: what was hidden and filled stays so.
TEST(CompoundPlates, MoveWithTheirBody) {
  CompoundShape turned = angle(1);
  const Eigen::Quaterniond quarter(Eigen::AngleAxisd(std::numbers::pi / 2, Vector3d::UnitZ()));
  for (PlacedShape& part : turned.parts) {
    part.position = quarter * part.position;
    part.orientation = quarter;
  }
  const CompoundCase<2> flow(turned, 1.2);
  for (const double y : {0.15, 0.25})
    for (const double x : {-0.15, -0.25}) EXPECT_NEAR(flow.filled({x, y}), 1.0, 1e-12) << x << ", " << y;
}

}  // namespace
}  // namespace sluice::fluid
