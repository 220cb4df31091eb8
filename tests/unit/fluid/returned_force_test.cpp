#include "fluid/returned_force.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "fluid/boundary_sweep.hpp"
#include "fluid/boundary_velocity.hpp"
#include "tests/unit/fluid/clouds.hpp"
#include "tests/unit/fluid/search_oracle.hpp"
#include "tests/unit/fluid/setups.hpp"

namespace sluice::fluid {
namespace {

constexpr double kSpacing = 0.1;

// A splash of any pressures, velocities and fits in the corner of a tank that a body is in.
template <int Dim>
class Splash {
 public:
  explicit Splash(std::uint64_t seed) : setup_(make_setup()), model_(setup_), boundary_(setup_) {
    std::mt19937_64 random(seed);
    fluid_ = particles_at<Dim>(jittered_lattice<Dim>(6, kSpacing, 0.4, random));
    for (std::size_t i = 0; i < fluid_.size(); ++i) {
      fluid_.node[i].v = 3.0 * random_vector<Dim>(random);
      fluid_.node[i].volume = particle_volume(kSpacing, Dim);
      fluid_.pressure.push_back(1e4 * (1.0 + random_vector<Dim>(random)[0]));
      const Mat<Dim> any = random_matrix<Dim>(random);
      Fit<Dim> fit;
      fit.G = (Mat<Dim>::Identity() + 0.2 * (any + any.transpose())) * model_.boundary_G;
      fit.g = model_.boundary_G * model_.h * random_vector<Dim>(random);
      fluid_.fit.push_back(fit);
    }
    std::vector<Kinematics> bodies(1);
    bodies[0].position = widen<Dim>(Vec<Dim>::Constant(0.7));
    bodies[0].velocity = {-1.0, 0.5, 0.0};
    bodies[0].angular_velocity = {0.0, 0.0, 2.0};
    boundary_.move(bodies);
    all_.resize(fluid_.size());
    std::iota(all_.begin(), all_.end(), 0u);
    for (std::size_t w = 0; w < boundary_.size(); ++w) {
      boundary_.one_sided[w] = kSingleRow * (0.5 + 0.5 * random_vector<Dim>(random)[0]);
      mirror_velocity<Dim>(model_, fluid_, all_, w, boundary_);
      extrapolate<Dim>(model_, fluid_, all_, w, boundary_);
    }
  }

  // Calls check(w, sums) for the boundary particles with pressure.
  template <typename Check>
  void for_wet(const Check& check) {
    std::size_t wet = 0;
    for (std::size_t w = 0; w < boundary_.size(); ++w) {
      if (boundary_.pressure[w] == 0.0) continue;
      SCOPED_TRACE("boundary particle " + std::to_string(w) + " of body " +
                   std::to_string(boundary_.body(w)));
      ++wet;
      check(w, sum_work<Dim>(model_, fluid_, all_, w, boundary_));
    }
    EXPECT_GT(wet, 20u);
  }

  [[nodiscard]] double work_on(std::size_t w, const Vec<Dim>& force) const {
    return force.dot(boundary_.node()[w].v - boundary_.velocity(w));
  }

  // Calls visit(i, f, x_iw) with the force that fluid i gets back.
  template <typename Visit>
  void for_returned(std::size_t w, const ReturnedForce<Dim>& back, const Visit& visit) const {
    for (std::size_t i = 0; i < fluid_.size(); ++i) {
      const Vec<Dim> x_iw = fluid_.node[i].x - boundary_.node()[w].x;
      visit(i, Vec<Dim>(model_.kernel.value(x_iw) * (back.s + back.S * x_iw)), x_iw);
    }
  }

  // sum_i f_i . u_i
  [[nodiscard]] double work_of(std::size_t w, const ReturnedForce<Dim>& back) const {
    double work = 0;
    for_returned(w, back, [&](std::size_t i, const Vec<Dim>& f, const Vec<Dim>&) {
      work += f.dot(fluid_.node[i].v - boundary_.velocity(w));
    });
    return work;
  }

  Setup setup_;
  Model<Dim> model_;
  BoundaryParticles<Dim> boundary_;
  Particles<Dim> fluid_;
  std::vector<std::uint32_t> all_;

 private:
  static Setup make_setup() {
    Scene scene(Dim, kSpacing, 9.81, 30.0);
    scene.add_tank({0, 0, 0}, {2, 2, Dim == 2 ? 0.0 : 2.0});
    scene.add_body(BoxShape{{0.15, 0.2, Dim == 3 ? 0.2 : 0.0}});
    scene.setup.fluid.position.emplace_back(0, 0, 0);
    return scene.setup;
  }
};

template <int Dim>
void check_return(std::uint64_t seed) {
  Splash<Dim> splash(seed);
  splash.for_wet([&](std::size_t w, const WorkSums<Dim>& sums) {
    const ReturnedForce<Dim> back = return_force<Dim>(splash.model_, sums, 1.0, w, splash.boundary_);
    Vec<Dim> force = Vec<Dim>::Zero();
    Eigen::Vector3d couple = Eigen::Vector3d::Zero();
    double scale = 0;
    splash.for_returned(w, back, [&](std::size_t, const Vec<Dim>& f, const Vec<Dim>& x_iw) {
      force += f;
      couple += widen<Dim>(x_iw).cross(widen<Dim>(f));
      scale += f.norm();
    });
    EXPECT_NEAR(splash.work_of(w, back), splash.work_on(w, sums.force), 1e-11 * scale);
    EXPECT_LT((force - back.force).norm(), 1e-12 * scale);
    EXPECT_LT((couple - back.couple).norm(), 1e-12 * scale);
  });
}

TEST(ReturnedForce, DoesTheWorkThatTheFluidDidAndAddsUp) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    check_return<2>(seed);
    check_return<3>(seed);
  }
}

// With the gain as a share of the work, up to which the pressure is kept in part: (1 - gain/full) of the gain
// is left, at most a quarter of `full`.
template <int Dim>
void check_gain(std::uint64_t seed) {
  Splash<Dim> splash(seed);
  std::size_t kept = 0, replaced = 0;
  splash.for_wet([&](std::size_t w, const WorkSums<Dim>& before) {
    splash.boundary_.impact[w] = 1.0;
    const double work = splash.work_on(w, before.force), pressure = splash.boundary_.pressure[w];
    const auto back = keep_work<Dim>(splash.model_, splash.fluid_, splash.all_, w, splash.boundary_);
    const double returned =
        sum_work<Dim>(splash.model_, splash.fluid_, splash.all_, w, splash.boundary_).returned +
        splash.work_of(w, back);
    const double rounding = 1e-11 * (std::abs(work) + std::abs(before.returned));
    EXPECT_LT(returned - work, 0.25 * kFullGain * std::abs(work) + rounding);
    if (before.returned <= work) {
      ++kept;
      EXPECT_EQ(splash.boundary_.pressure[w], pressure);
      EXPECT_TRUE(back.force.isZero(0.0));
    } else {
      ++replaced;
      EXPECT_LT(splash.boundary_.pressure[w], pressure);
    }
  });
  EXPECT_GT(kept, 3u);
  EXPECT_GT(replaced, 3u);
}

TEST(ReturnedForce, LeavesNoGainOfEnergyAndNoLossAlone) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    check_gain<2>(seed);
    check_gain<3>(seed);
  }
}

TEST(Impact, IsPressureOfManyRowsOnOneSidedFluid) {
  constexpr double kRow = 100.0;
  EXPECT_EQ(impact(2.0 * kRow, kRow, 1.0), 0.0);
  EXPECT_DOUBLE_EQ(impact(3.0 * kRow, kRow, 1.0), 0.5);
  EXPECT_EQ(impact(4.0 * kRow, kRow, 1.0), 1.0);
  EXPECT_EQ(impact(1e9, kRow, 0.02), 0.0) << "deep in a tank at rest";
  EXPECT_EQ(impact(0.0, 0.0, 1.0), 0.0) << "dry";
  EXPECT_EQ(impact(1.0, 0.0, 0.04), 1.0) << "no gravity";
}

}  // namespace
}  // namespace sluice::fluid
