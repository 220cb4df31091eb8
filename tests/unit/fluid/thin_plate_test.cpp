#include "fluid/thin_plate.hpp"

#include <gtest/gtest.h>

#include "tests/unit/fluid/plates.hpp"

namespace sluice::fluid {
namespace {

// 0.1 x 1 about the origin.
class UprightPlate : public testing::Test {
 protected:
  PlateCase<2> gate_{{0.05, 0.5, 0}};
  const Plate<2>& plate_ = gate_.plate();
  std::size_t left_ = face_with(gate_, -Eigen::Vector3d::UnitX());
  std::size_t right_ = face_with(gate_, Eigen::Vector3d::UnitX());
  std::size_t top_ = face_with(gate_, Eigen::Vector3d::UnitY());
};

TEST_F(UprightPlate, HasItsFourFaces) {
  ASSERT_EQ(plate_.faces.size(), 4u);
  for (const Plane<2>& face : plate_.faces) {
    EXPECT_NEAR(face.normal.norm(), 1.0, 1e-15);
    EXPECT_LT(face.distance(Vec<2>::Zero()), 0.0);  // outward
  }
  EXPECT_NEAR(plate_.faces[right_].distance(Vec<2>(0.25, 9.0)), 0.2, 1e-15);
}

TEST_F(UprightPlate, FluidSeesTheFaceItIsInFrontOf) {
  const Vec<2> right_of_it(0.06, 0.1);
  EXPECT_TRUE(sees_face(plate_, right_, right_of_it));
  EXPECT_FALSE(sees_face(plate_, left_, right_of_it));
  EXPECT_FALSE(sees_face(plate_, top_, right_of_it));
  const Vec<2> off_the_corner(0.06, 0.51);
  EXPECT_TRUE(sees_face(plate_, right_, off_the_corner));
  EXPECT_TRUE(sees_face(plate_, top_, off_the_corner));
  EXPECT_FALSE(sees_face(plate_, left_, off_the_corner));
}

TEST_F(UprightPlate, FluidInsideSeesTheNearestFaceOnly) {
  EXPECT_TRUE(sees_face(plate_, right_, Vec<2>(0.04, 0.1)));
  EXPECT_FALSE(sees_face(plate_, left_, Vec<2>(0.04, 0.1)));
  EXPECT_TRUE(sees_face(plate_, left_, Vec<2>(-0.01, 0.1)));
  EXPECT_TRUE(sees_face(plate_, top_, Vec<2>(0.02, 0.49)));
  EXPECT_FALSE(sees_face(plate_, right_, Vec<2>(0.02, 0.49)));
}

TEST_F(UprightPlate, SeparatesWhatIsOnOppositeSides) {
  EXPECT_TRUE(separates(plate_, Vec<2>(-0.1, 0.0), Vec<2>(0.1, 0.0)));
  EXPECT_TRUE(separates(plate_, Vec<2>(-0.06, 0.4), Vec<2>(0.06, -0.4)));
  EXPECT_TRUE(separates(plate_, Vec<2>(0.0, 0.6), Vec<2>(0.1, 0.3)));  // cuts a corner off
}

TEST_F(UprightPlate, DoesNotSeparateWhatSeesEachOtherPastIt) {
  EXPECT_FALSE(separates(plate_, Vec<2>(0.06, -0.4), Vec<2>(0.06, 0.4)));
  EXPECT_FALSE(separates(plate_, Vec<2>(-0.1, 0.51), Vec<2>(0.1, 0.51)));
  EXPECT_FALSE(separates(plate_, Vec<2>(0.0, 0.8), Vec<2>(0.3, 0.4)));
  EXPECT_FALSE(separates(plate_, Vec<2>(0.2, 0.0), Vec<2>(0.1, 0.0)));  // it would be hit farther on
}

TEST_F(UprightPlate, IsNearWithinReachOfItsFaces) {
  EXPECT_TRUE(is_near(plate_, Vec<2>(0.0, 0.6), 0.2));
  EXPECT_TRUE(is_near(plate_, Vec<2>(0.2, 0.0), 0.2));
  EXPECT_FALSE(is_near(plate_, Vec<2>(0.4, 0.0), 0.2));
  EXPECT_FALSE(is_near(plate_, Vec<2>(0.0, 2.0), 0.2));
}

TEST(FlatPlate, RulesHoldInSpace) {
  const PlateCase<3> lid({0.5, 0.5, 0.05});
  const Plate<3>& plate = lid.plate();
  ASSERT_EQ(plate.faces.size(), 6u);
  const std::size_t above = face_with(lid, Eigen::Vector3d::UnitZ());
  const std::size_t below = face_with(lid, -Eigen::Vector3d::UnitZ());
  EXPECT_TRUE(sees_face(plate, above, Vec<3>(0.1, 0.2, 0.06)));
  EXPECT_FALSE(sees_face(plate, below, Vec<3>(0.1, 0.2, 0.06)));
  EXPECT_TRUE(sees_face(plate, below, Vec<3>(0.1, 0.2, -0.04)));
  EXPECT_TRUE(separates(plate, Vec<3>(0.1, 0.2, 0.1), Vec<3>(0.2, 0.1, -0.1)));
  EXPECT_FALSE(separates(plate, Vec<3>(0.6, 0.2, 0.1), Vec<3>(0.6, 0.1, -0.1)));
  EXPECT_FALSE(separates(plate, Vec<3>(0.6, 0.6, 0.1), Vec<3>(0.45, 0.6, -0.1)));
}

// Any pose: the clipping agrees with the shape's signed distance along the segment.
template <int Dim>
void check_random_segments(const Eigen::Vector3d& half_size) {
  std::mt19937_64 random(31);
  PlateCase<Dim> plate_case(half_size);
  int cut = 0, free = 0;
  for (int k = 0; k < 6000; ++k) {
    if (k % 30 == 0) plate_case.move_to(random_pose<Dim>(random));
    const Vec<Dim> x = random_vector<Dim>(random), y = x + 0.8 * random_vector<Dim>(random);
    if (plate_case.distance(x) <= 0.0 || plate_case.distance(y) <= 0.0) continue;
    double lowest = 1.0;
    for (int s = 0; s <= 400; ++s) lowest = std::min(lowest, plate_case.distance(x + s / 400.0 * (y - x)));
    if (std::abs(lowest) < 5e-3) continue;  // grazes: the samples may miss the corner
    lowest < 0.0 ? ++cut : ++free;
    EXPECT_EQ(separates(plate_case.plate(), x, y), lowest < 0.0) << "segment " << k;
  }
  EXPECT_GT(cut, 100);
  EXPECT_GT(free, 100);
}

TEST(ThinPlate, ClippingAgreesWithTheSignedDistance) {
  check_random_segments<2>({0.05, 0.5, 0});
  check_random_segments<3>({0.05, 0.5, 0.4});
}

// If one particle saw the other and not the other way round, their forces would not cancel.
template <int Dim>
void check_grazing_pairs(const Eigen::Vector3d& half_size) {
  std::mt19937_64 random(32);
  PlateCase<Dim> plate_case(half_size);
  for (int k = 0; k < 20000; ++k) {
    if (k % 50 == 0) plate_case.move_to(random_pose<Dim>(random));
    const Kinematics& pose = plate_case.pose;
    const Vec<Dim> corner = narrow<Dim>(pose.position + pose.orientation * half_size);
    const Vec<Dim> direction = random_direction<Dim>(random);
    const Vec<Dim> x = corner + 0.2 * direction, y = corner - 0.1 * direction;
    ASSERT_EQ(separates(plate_case.plate(), x, y), separates(plate_case.plate(), y, x)) << "pair " << k;
  }
}

TEST(ThinPlate, SeparationIsMutualAlsoForPairsThatGrazeAnEdge) {
  check_grazing_pairs<2>({0.05, 0.5, 0});
  check_grazing_pairs<3>({0.05, 0.5, 0.4});
}

// A particle pressed a little into a face still belongs to the fluid in front of it: it must neither lose its
// neighbours there nor find new ones behind the plate.
TEST_F(UprightPlate, FluidPressedIntoAFaceStaysWithItsSide) {
  const Vec<2> pressed_in(0.049, 0.1);
  EXPECT_FALSE(separates(plate_, pressed_in, Vec<2>(0.06, 0.1)));
  EXPECT_FALSE(separates(plate_, Vec<2>(0.06, 0.1), pressed_in));
  EXPECT_FALSE(separates(plate_, pressed_in, Vec<2>(0.049, 0.12)));
  EXPECT_TRUE(separates(plate_, pressed_in, Vec<2>(-0.06, 0.1)));
  EXPECT_TRUE(separates(plate_, pressed_in, Vec<2>(-0.049, 0.1)));
}

}  // namespace
}  // namespace sluice::fluid
