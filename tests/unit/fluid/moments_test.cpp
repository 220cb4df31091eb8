#include "fluid/moments.hpp"

#include <gtest/gtest.h>

#include <string>

#include "fluid/kernel.hpp"
#include "fluid/lattice.hpp"
#include "tests/unit/fluid/clouds.hpp"

namespace sluice::fluid {
namespace {

constexpr double kSpacing = 0.02, kFloor = 0.2;

// A disordered block of particles of unequal volume, free on all sides, and the fits on it.
template <int Dim>
struct Block {
  static constexpr int kCells = Dim == 2 ? 15 : 9;

  explicit Block(std::uint64_t seed) : kernel(1.5 * kSpacing) {
    std::mt19937_64 random(seed);
    x = jittered_lattice<Dim>(kCells, kSpacing, 0.25, random);
    std::uniform_real_distribution<double> share(0.8, 1.2);
    for (std::size_t j = 0; j < x.size(); ++j) volume.push_back(share(random) * std::pow(kSpacing, Dim));
  }

  [[nodiscard]] double weight(std::size_t i, std::size_t j) const {
    return volume[j] * kernel.value((x[j] - x[i]).squaredNorm());
  }
  [[nodiscard]] Moments<Dim> moments(std::size_t i) const {
    Moments<Dim> m;
    for (std::size_t j = 0; j < x.size(); ++j) m.add(weight(i, j), x[j] - x[i]);
    return m;
  }
  [[nodiscard]] double floor() const { return kFloor * lattice_moment<Dim>(kernel, kSpacing); }

  WendlandC2<Dim> kernel;
  std::vector<Vec<Dim>> x;
  std::vector<double> volume;
};

// CF (16)-(17), errors in units of the spacing.
template <int Dim>
void expect_linear_consistency(const Block<Dim>& block, std::size_t i, const Moments<Dim>& m,
                               const Fit<Dim>& f) {
  double sum_N = 0;
  Vec<Dim> sum_Nx = Vec<Dim>::Zero(), sum_grad = Vec<Dim>::Zero();
  Mat<Dim> sum_x_grad = Mat<Dim>::Zero();
  for (std::size_t j = 0; j < block.x.size(); ++j) {
    const Vec<Dim> linear = f.g + f.G * (block.x[j] - block.x[i]);
    const double N = block.weight(i, j) * (1.0 - m.m1.dot(linear)) / m.m0;
    const Vec<Dim> grad_N = block.weight(i, j) * linear;
    sum_N += N;
    sum_Nx += N * block.x[j];
    sum_grad += grad_N;
    sum_x_grad += block.x[j] * grad_N.transpose();
  }
  EXPECT_NEAR(sum_N, 1.0, 1e-12) << "particle " << i;
  EXPECT_LT((sum_Nx - block.x[i]).norm() / kSpacing, 1e-12) << "particle " << i;
  EXPECT_LT(sum_grad.norm() * kSpacing, 1e-12) << "particle " << i;
  EXPECT_LT((sum_x_grad - Mat<Dim>::Identity()).norm(), 1e-12) << "particle " << i;
}

template <int Dim>
void check_block(std::uint64_t seed) {
  SCOPED_TRACE("dimension " + std::to_string(Dim) + ", seed " + std::to_string(seed));
  const Block<Dim> block(seed);
  std::size_t fitted = 0;
  for (std::size_t i = 0; i < block.x.size(); ++i) {
    const Moments<Dim> m = block.moments(i);
    const Fit<Dim> f = fit(m, block.floor());
    if (f.floored) continue;
    ++fitted;
    expect_linear_consistency(block, i, m, f);
  }
  // The floor is for spray: all but the edges of a block must have their exact fit, free faces too.
  EXPECT_GE(fitted, block.x.size() - edge_particles<Dim>(Block<Dim>::kCells));
}

TEST(Moments, ShapeFunctionsAreLinearlyConsistentInThePlane) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) check_block<2>(seed);
}

TEST(Moments, ShapeFunctionsAreLinearlyConsistentInSpace) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) check_block<3>(seed);
}

template <int Dim>
void check_lattice_moment() {
  const WendlandC2<Dim> kernel(1.5 * kSpacing);
  Moments<Dim> m;
  std::mt19937_64 unused;
  const auto lattice = jittered_lattice<Dim>(9, kSpacing, 0.0, unused);
  const Vec<Dim> center = lattice[lattice.size() / 2];
  for (const Vec<Dim>& x : lattice)
    m.add(std::pow(kSpacing, Dim) * kernel.value((x - center).squaredNorm()), x - center);
  EXPECT_NEAR(m.m0, 1.0, 0.02);  // the lattice's sum approximates the kernel's integral
  EXPECT_LT(m.m1.norm(), 1e-14);
  const double moment = lattice_moment<Dim>(kernel, kSpacing);
  EXPECT_LT((m.m2 - moment * Mat<Dim>::Identity()).norm(), 1e-14 * moment);
}

TEST(Moments, LatticeMomentIsThatOfAParticleInTheMiddle) {
  check_lattice_moment<2>();
  check_lattice_moment<3>();
}

// A clump of eight particles within a spacing and nothing else near: m0 |G|, the square of the frequency at
// which it can oscillate over c0^2, is no larger than the floor lets it be where a lattice fills the support.
TEST(Moments, ACrowdOscillatesNoFasterThanTheFloorLets) {
  const WendlandC2<2> kernel(1.5 * kSpacing);
  const double floor = kFloor * lattice_moment<2>(kernel, kSpacing);
  const auto frequency2 = [&](double size) {
    Moments<2> m;
    for (int k = 0; k < 8; ++k) {
      const Vec<2> x = size * kSpacing * (Vec<2>(k % 4, k / 4) - Vec<2>(1.5, 0.5));
      m.add(kSpacing * kSpacing * kernel.value(x), x);
    }
    EXPECT_GT(m.m0, 1.2);
    return m.m0 * fit(m, floor).G.full().operatorNorm();
  };
  for (const double size : {0.1, 0.2, 0.4, 0.6}) EXPECT_LE(frequency2(size), (1.0 + 1e-12) / floor) << size;
}

}  // namespace
}  // namespace sluice::fluid
