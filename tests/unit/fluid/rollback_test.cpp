#include <gtest/gtest.h>

#include <cstring>

#include "tests/unit/fluid/splash.hpp"

namespace sluice::fluid {
namespace {

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

std::vector<double> forces(const Solver& solver) {
  std::vector<double> all{solver.diagnostics().boundary_work};
  for (const Wrench& w : solver.wrenches()) {
    all.insert(all.end(), w.force.begin(), w.force.end());
    all.insert(all.end(), w.moment.begin(), w.moment.end());
  }
  return all;
}

// From the saved state, `steps` steps once with other motions and then with the right ones: to the last bit
// what a solver does that never went back.
void expect_rollback_is_exact(Splash& straight, Splash& back, int steps) {
  for (int k = 0; k < 20; ++k) {
    straight.step();
    back.step();
  }
  for (int window = 0; window < 6; ++window) {
    back.solver().save();
    for (int k = 0; k < steps; ++k) {
      std::array<Kinematics, 2> wrong;
      std::copy_n(back.bodies().begin(), 2, wrong.begin());
      for (Kinematics& body : wrong) body.position.x() += 1e-3 * (k + 1);
      back.solver().step(back.dt(), wrong);
    }
    back.solver().restore();
    for (int k = 0; k < steps; ++k) {
      straight.step();
      back.step();
    }
    ASSERT_TRUE(same_bits(forces(straight.solver()), forces(back.solver()))) << "window " << window;
  }
  EXPECT_TRUE(same_bits(straight.solver().snapshot().position, back.solver().snapshot().position));
  EXPECT_TRUE(same_bits(straight.solver().snapshot().density, back.solver().snapshot().density));
}

TEST(Rollback, IsExactInThePlane) {
  Splash straight(2, 20, 1), back(2, 20, 1);
  expect_rollback_is_exact(straight, back, 1);
}

// Over so many steps the neighbour lists are made anew within a window.
TEST(Rollback, IsExactOverARebuildOfTheLists) {
  Splash straight(2, 0, 1), back(2, 0, 2);
  expect_rollback_is_exact(straight, back, 30);
}

TEST(Rollback, IsExactOverADriftOfCrowds) {
  const auto spread = [](Formulation& f) { f.spreading = 0.05; };
  Splash straight(2, 0, 1, spread), back(2, 0, 2, spread);
  expect_rollback_is_exact(straight, back, 30);
}

TEST(Rollback, IsExactInSpace) {
  Splash straight(3, 0, 1), back(3, 0, 1);
  expect_rollback_is_exact(straight, back, 4);
}

TEST(Rollback, IsExactWithStateOfEarlierSteps) {
  for (const Integrator integrator : {Integrator::multistep, Integrator::predictor_corrector}) {
    const auto choose = [&](Formulation& f) {
      f.integrator = integrator;
      f.shifting = 4;
      f.courant = 0.2;
    };
    Splash straight(2, 0, 1, choose), back(2, 0, 1, choose);
    expect_rollback_is_exact(straight, back, 5);
  }
}

// Viscous, guard and pressure parts sum to the wrench; without viscosity there is no viscous one.
TEST(WrenchParts, SumToTheWrench) {
  for (const double viscosity : {0.0, 20.0}) {
    Splash splash(2, viscosity, 1);
    double viscous = 0, guard = 0;
    for (int k = 0; k < 150; ++k) {
      splash.step();
      const std::vector<WrenchParts> parts = splash.solver().wrench_parts();
      for (std::size_t b = 0; b < parts.size(); ++b) {
        const Wrench& all = splash.solver().wrenches()[b];
        const Eigen::Vector3d sum = parts[b].pressure.force + parts[b].viscous.force + parts[b].guard.force;
        EXPECT_LT((sum - all.force).norm(), 1e-12 * (1 + all.force.norm()));
        viscous += parts[b].viscous.force.norm() + parts[b].viscous.moment.norm();
        guard += parts[b].guard.force.norm();
      }
    }
    EXPECT_GT(guard, 0);
    EXPECT_EQ(viscous > 0, viscosity > 0);
  }
}

}  // namespace
}  // namespace sluice::fluid
