#include "fluid/group_stages.hpp"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include "fluid/boundary_sweep.hpp"
#include "fluid/boundary_velocity.hpp"
#include "fluid/galerkin_stages.hpp"
#include "fluid/returned_force.hpp"
#include "tests/unit/fluid/clouds.hpp"
#include "tests/unit/fluid/setups.hpp"

namespace sluice::fluid {
namespace {

constexpr double kSpacing = 0.1;

// Disordered water with spray in the corner of a tank, at a thick box and a thin plate that move: fluid
// behind which the group stages and the sweeps of single particles can be compared, stage by stage.
template <int Dim>
class Water {
 public:
  explicit Water(std::uint64_t seed) : random_(seed), setup_(make_setup(random_)) {
    setup_.formulation.smoothing = stable_smoothing(Dim);
    model_.emplace(setup_);
    boundary_.emplace(setup_);
    fluid_ = stages::make_particles<Dim>(setup_, model_->eos, false);
    std::vector<Kinematics> bodies(2);
    bodies[0].position = {1.3, 0.4, 0.4};
    bodies[0].velocity = {-1.0, 0.5, 0.0};
    bodies[1].position = {0.55, 0.5, 0.4};
    bodies[1].velocity = {0.5, 0.1, 0.0};
    bodies[1].angular_velocity = {0.0, 0.0, 0.7};
    boundary_->move(bodies);
    const SearchPlan plan{.groups = true, .cell = group_edge<Dim>(kSpacing)};
    search_.emplace(model_->kernel.support(), 0.1 * model_->kernel.support(), Period{}, plan);
    search_->update(fluid_, *boundary_, parallel_);
  }

  [[nodiscard]] GroupStages<Dim> groups() { return {*model_, search_->groups(), parallel_, close_}; }

  void mirror_singly(BoundaryParticles<Dim>& boundary) const {
    for_active([&](std::size_t a, std::size_t w) {
      mirror_velocity<Dim>(*model_, fluid_, search_->fluid_near_active(a), w, boundary);
    });
  }
  [[nodiscard]] std::vector<Gradients<Dim>> gradients_singly() const {
    std::vector<Gradients<Dim>> all;
    for (std::size_t i = 0; i < fluid_.size(); ++i) {
      GradientSweep<Dim> sweep(*model_, fluid_.node[i]);
      sweep.gather(search_->fluid_near_fluid(i), fluid_.node);
      sweep.gather(search_->boundary_near_fluid(i), boundary_->node());
      all.push_back(sweep.finish());
    }
    return all;
  }
  void set_sources() {
    for (std::size_t i = 0; i < fluid_.size(); ++i) {
      fluid_.pressure[i] = model_->eos.pressure(fluid_.node[i].rho);
      set_source<Dim>(fluid_.node[i].volume, -fluid_.pressure[i] * Mat<Dim>::Identity(), fluid_.fit[i],
                      fluid_.source[i]);
    }
  }
  void keep_pressure_alone() {
    fluid_.source.clear();
    for (std::size_t i = 0; i < fluid_.size(); ++i)
      fluid_.gradients[i].V_sigma = -fluid_.node[i].volume * fluid_.pressure[i];
  }
  void extrapolate_singly(BoundaryParticles<Dim>& boundary) const {
    for_active([&](std::size_t a, std::size_t w) {
      extrapolate<Dim>(*model_, fluid_, search_->fluid_near_active(a), w, boundary);
    });
  }
  [[nodiscard]] std::pair<Vec<Dim>, double> force_singly(std::size_t i) const {
    ForceSweep<Dim> sweep(*model_, fluid_, i);
    sweep.gather_fluid(search_->fluid_near_fluid(i));
    sweep.gather_boundary(search_->boundary_near_fluid(i), *boundary_);
    return {model_->gravity + sweep.force() / fluid_.mass[i], sweep.density_rate()};
  }
  // Of all boundary particles with pressure, as if they were in an impact; the number that return a force.
  std::size_t return_forces() {
    std::vector<std::size_t> hit, place;
    for_active([&](std::size_t a, std::size_t w) {
      if (boundary_->pressure[w] == 0.0) return;
      hit.push_back(w);
      place.push_back(a);
    });
    boundary_->make_returning(hit);
    std::size_t returning = 0;
    for (std::size_t k = 0; k < hit.size(); ++k) {
      boundary_->impact[hit[k]] = 1.0;
      ReturnedForce<Dim>& back = boundary_->returned_force[k];
      back = keep_work<Dim>(*model_, fluid_, search_->fluid_near_active(place[k]), hit[k], *boundary_);
      returning += back.force.isZero(0.0) ? 0 : 1;
    }
    return returning;
  }
  template <typename Visit>
  void for_active(const Visit& visit) const {
    const auto& active = search_->active_boundary();
    for (std::size_t a = 0; a < active.size(); ++a) visit(a, active[a]);
  }

  std::mt19937_64 random_;
  Setup setup_;
  Parallel parallel_{1};
  std::optional<Model<Dim>> model_;
  std::optional<BoundaryParticles<Dim>> boundary_;
  std::optional<NeighborSearch<Dim>> search_;
  Particles<Dim> fluid_;
  CloseList close_;

 private:
  static Setup make_setup(std::mt19937_64& random) {
    Scene scene(Dim, kSpacing, 9.81, 30.0);
    const double depth = Dim == 3 ? 0.8 : 0.0;
    scene.add_tank({0, 0, 0}, Dim == 2 ? Eigen::Vector3d(2, 2, 0) : Eigen::Vector3d(2, 2, 2));
    scene.add_body(BoxShape{{0.31, 0.3, Dim == 3 ? 0.3 : 0.0}});
    scene.add_body(BoxShape{{0.05, 0.4, Dim == 3 ? 0.4 : 0.0}});
    scene.add_block({0.05, 0.05, Dim == 3 ? 0.05 : 0.0}, {0.95, 0.85, depth}, {0, 0, 0});
    // Spray, some of it alone.
    for (int k = 0; k < 12; ++k)
      scene.add_particle(
          Eigen::Vector3d(1.5, 1.5, Dim == 3 ? 1.0 : 0.0) + 0.3 * widen<Dim>(random_vector<Dim>(random)),
          {0, 0, 0}, 0.0);
    for (auto& x : scene.setup.fluid.position) x += 0.2 * kSpacing * widen<Dim>(random_vector<Dim>(random));
    for (auto& v : scene.setup.fluid.velocity) v = 2.0 * widen<Dim>(random_vector<Dim>(random));
    for (double& p : scene.setup.fluid.pressure) p = 5000.0 * random_vector<Dim>(random)[0];
    return scene.setup;
  }
};

// Of what is compared the largest, for a tolerance of rounding.
template <typename Matrix>
void expect_same(const Matrix& a, const Matrix& b, double scale, std::size_t index, const char* what) {
  EXPECT_LT((a - b).norm(), 1e-11 * scale) << what << " of " << index;
}

template <int Dim>
void check_gradients(std::uint64_t seed) {
  SCOPED_TRACE("dimension " + std::to_string(Dim) + ", seed " + std::to_string(seed));
  Water<Dim> water(seed);
  BoundaryParticles<Dim> mirrored = *water.boundary_;
  water.mirror_singly(*water.boundary_);
  water.groups().mirror_velocities(water.fluid_, mirrored);
  std::size_t active = 0, plates = 0;
  water.for_active([&](std::size_t, std::size_t w) {
    ++active;
    plates += mirrored.plate(w) >= 0 ? 1 : 0;
    expect_same(mirrored.node()[w].v, water.boundary_->node()[w].v, 10.0, w, "mirrored velocity");
  });
  EXPECT_GT(active, 50u);
  EXPECT_GT(plates, 10u);
  const std::vector<Gradients<Dim>> singly = water.gradients_singly();
  water.groups().compute_gradients(*water.boundary_, water.fluid_);
  std::size_t floored = 0;
  for (std::size_t i = 0; i < singly.size(); ++i) {
    const Fit<Dim>& fit = water.fluid_.fit[i];
    floored += fit.floored ? 1 : 0;
    EXPECT_EQ(fit.floored, singly[i].fit.floored) << i;
    EXPECT_NEAR(fit.m0, singly[i].fit.m0, 1e-12);
    expect_same(fit.g, singly[i].fit.g, 1.0 / kSpacing, i, "g");
    expect_same(fit.G.full(), singly[i].fit.G.full(), 10.0 / (kSpacing * kSpacing), i, "G");
    expect_same(water.fluid_.gradients[i].grad_rho(), singly[i].grad_rho, 1000.0 / kSpacing, i, "grad rho");
    expect_same(water.fluid_.gradients[i].strain(), strain_rate<Dim>(singly[i].L), 100.0 / kSpacing, i,
                "strain");
    EXPECT_NEAR(water.fluid_.divergence[i], singly[i].L.trace(), 1e-9 / kSpacing);
  }
  EXPECT_GT(floored, 3u);
  EXPECT_LT(floored, singly.size() / 2);
}

template <int Dim>
void check_forces_of_groups(Water<Dim>& water, const std::vector<Reaction<Dim>>& reactions,
                            const std::vector<std::pair<Vec<Dim>, double>>& forces) {
  SCOPED_TRACE(water.fluid_.source.empty() ? "pressure alone" : "any stress");
  std::vector<Reaction<Dim>> reaction(reactions.size());
  water.groups().react(water.fluid_, *water.boundary_, water.search_->groups().active_boundary(), reaction);
  water.for_active([&](std::size_t, std::size_t w) {
    expect_same(reaction[w].force, reactions[w].force, 1000.0, w, "reaction");
    expect_same(reaction[w].couple, reactions[w].couple, 1000.0, w, "couple of the reaction");
  });
  water.groups().compute_forces(*water.boundary_, MirrorGuard<Dim>({}, *water.model_), water.fluid_);
  for (std::size_t i = 0; i < forces.size(); ++i) {
    expect_same(water.fluid_.acceleration[i], forces[i].first, 1e4, i, "acceleration");
    EXPECT_NEAR(water.fluid_.density_rate[i], forces[i].second, 1e-7) << i;
  }
}

template <int Dim>
void check_forces(std::uint64_t seed) {
  SCOPED_TRACE("dimension " + std::to_string(Dim) + ", seed " + std::to_string(seed));
  Water<Dim> water(seed);
  water.groups().mirror_velocities(water.fluid_, *water.boundary_);
  water.groups().compute_gradients(*water.boundary_, water.fluid_);
  water.set_sources();
  BoundaryParticles<Dim> extrapolated = *water.boundary_;
  water.extrapolate_singly(*water.boundary_);
  water.groups().extrapolate(water.fluid_, extrapolated);
  double wet = 0;
  water.for_active([&](std::size_t, std::size_t w) {
    wet = std::max(wet, extrapolated.pressure[w]);
    EXPECT_NEAR(extrapolated.pressure[w], water.boundary_->pressure[w], 1e-6) << w;
    EXPECT_NEAR(extrapolated.dilation[w], water.boundary_->dilation[w], 1e-9) << w;
    EXPECT_NEAR(extrapolated.node()[w].rho, water.boundary_->node()[w].rho, 1e-9) << w;
    EXPECT_NEAR(extrapolated.impact[w], water.boundary_->impact[w], 1e-9) << w;
  });
  EXPECT_GT(wet, 500.0);
  EXPECT_GT(water.return_forces(), 10u);
  std::vector<Reaction<Dim>> reactions(water.boundary_->size());
  water.for_active([&](std::size_t a, std::size_t w) {
    reactions[w] =
        reaction<Dim>(*water.model_, water.fluid_, water.search_->fluid_near_active(a), w, *water.boundary_);
  });
  std::vector<std::pair<Vec<Dim>, double>> forces;
  for (std::size_t i = 0; i < water.fluid_.size(); ++i) forces.push_back(water.force_singly(i));
  check_forces_of_groups(water, reactions, forces);
  water.keep_pressure_alone();
  check_forces_of_groups(water, reactions, forces);
}

// With every instruction set that the build and the processor have.
template <typename Check>
void for_instruction_sets(const Check& check) {
  const std::int64_t all = hwy::SupportedTargets();
  for (std::int64_t left = all; left != 0; left &= left - 1) {
    SCOPED_TRACE(hwy::TargetName(left & -left));
    hwy::SetSupportedTargetsForTest(left & -left);
    check();
  }
  hwy::SetSupportedTargetsForTest(0);
}

TEST(GroupStages, MirrorAndGradientsAreThoseOfSingleParticles) {
  for_instruction_sets([] {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      check_gradients<2>(seed);
      check_gradients<3>(seed);
    }
  });
}

TEST(GroupStages, ForcesAndReactionsAreThoseOfSingleParticles) {
  for_instruction_sets([] {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      check_forces<2>(seed);
      check_forces<3>(seed);
    }
  });
}

}  // namespace
}  // namespace sluice::fluid
