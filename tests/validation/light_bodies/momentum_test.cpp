#include <gtest/gtest.h>

#include <cmath>

#include "validation/support/files.hpp"
#include "validation/support/scene_run.hpp"

namespace sluice::validation {
namespace {

struct Scheme {
  const char* name;
  std::vector<std::string> overrides;
};
constexpr double kEnergy = 1e-3;  // that the interface may make, over the work that passed

constexpr const char* kTowed = "body[0].prescribed={sinusoid {offset: [0.05, 0] frequency: 3}}";

std::vector<Scheme> schemes() {
  const std::string loose = "coupling.tolerance=0.3", free = "coupling.shorten_steps=false";
  return {{"explicit", {"coupling.scheme=EXPLICIT", free}},
          {"explicit, 4 steps", {"coupling.scheme=EXPLICIT", "coupling.steps_per_exchange=4", free}},
          {"explicit, 16 steps",
           {"coupling.scheme=EXPLICIT", "coupling.steps_per_exchange=16", "body[0].density=2500", free}},
          {"implicit", {"coupling.scheme=IMPLICIT"}},
          {"implicit, hardly converged", {"coupling.scheme=IMPLICIT", loose}},
          {"implicit, 4 steps", {"coupling.scheme=IMPLICIT", "coupling.steps_per_exchange=4"}},
          {"towed", {"coupling.scheme=EXPLICIT", free, kTowed, "body[0].free=[Y_AXIS]"}},
          {"towed, turning freely, implicit",
           {"coupling.scheme=IMPLICIT", kTowed, "body[0].free=[Y_AXIS]", "body[0].free_rotation=[Z_AXIS]"}}};
}

// What changes between two exchanges, and what changed it.
class Balance {
 public:
  explicit Balance(const SceneRun& run) : run_(run), mass_(run.world().mass(0)) {
    for (const double m : run.masses()) liquid_ += m;
    remember();
    start_ = energy();
  }

  // The momentum that appeared in an exchange over what was passed in it.
  double exchange() {
    const double dt = run_.time() - time_;
    const Eigen::Vector3d g(0, -9.81, 0);
    const Eigen::Vector3d by_walls = walls_ - run_.wall_impulse();
    const Eigen::Vector3d gained =
        momentum() - momentum_ - dt * (liquid_ + mass_) * g - by_walls - (drive().impulse.force - driven_);
    const double passed = (run_.body_impulse() - bodies_).norm() + by_walls.norm();
    work_ += std::abs(run_.solver().diagnostics().boundary_work - boundary_work_);
    remember();
    return gained.norm() / passed;
  }

  // Energy made at the interface over the work that passed through it.
  [[nodiscard]] double created() const { return (energy() - start_) / work_; }

 private:
  [[nodiscard]] Eigen::Vector3d momentum() const {
    return run_.solver().diagnostics().momentum + mass_ * run_.world().state(0).velocity;
  }
  // Of the body, and that given to the liquid.
  [[nodiscard]] double energy() const {
    const rigid::Kinematics body = run_.world().state(0);
    return run_.world().kinetic_energy(0) + mass_ * 9.81 * body.position.y() - drive().work +
           run_.solver().diagnostics().boundary_work;
  }
  [[nodiscard]] rigid::Given drive() const { return run_.world().account(0).drive; }
  void remember() {
    driven_ = drive().impulse.force;
    time_ = run_.time();
    momentum_ = momentum();
    walls_ = run_.wall_impulse();
    bodies_ = run_.body_impulse();
    boundary_work_ = run_.solver().diagnostics().boundary_work;
  }

  const SceneRun& run_;
  double mass_, liquid_ = 0, time_ = 0, boundary_work_ = 0, work_ = 0, start_ = 0;
  Eigen::Vector3d momentum_, walls_, bodies_, driven_;
};

// A box drops in. Liquid, body and walls keep their momentum in every exchange, and the interface makes next
// to no energy. Sixteen explicit steps are allowed for heavier bodies only.
TEST(Coupling, MomentumClosesAndTheInterfaceMakesNoEnergy) {
  for (const Scheme& scheme : schemes()) {
    SCOPED_TRACE(scheme.name);
    std::vector<std::string> overrides = scheme.overrides;
    overrides.insert(overrides.begin(), {"body[0].density=500", "duration=0.15"});
    SceneRun run(case_file("light_bodies/box_drop.scene"), overrides, 1, Walls::kForceMeasured);
    Balance balance(run);
    double worst = 0;
    while (run.next_step()) worst = std::max(worst, balance.exchange());
    EXPECT_LT(worst, 1e-10);
    EXPECT_LT(std::abs(balance.created()), kEnergy);
    std::printf("%s: momentum within %.1e, energy made at the interface %.1e of the work\n", scheme.name,
                worst, balance.created());
  }
}

}  // namespace
}  // namespace sluice::validation
