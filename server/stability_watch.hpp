#pragma once

#include <optional>
#include <span>
#include <vector>

#include "fluid/solver.hpp"
#include "messages.pb.h"
#include "protocol/sim_time.hpp"
#include "scene.pb.h"
#include "server/wet_surface.hpp"

namespace sluice::server {

struct CouplingPlan;

// The surface of a body whose forces move it at some time of the run; nothing of others.
std::optional<WetSurface> wet_surface(const Scene& scene, std::size_t body, const fluid::Boundary& boundary);

// Whether the exchange with the free bodies is known to be stable as the run goes: by the surface that is wet
// now, and by whether iterated exchanges converge. What it sees is said once for every body, or ends the run
// (Coupling.when_unstable).
class StabilityWatch {
 public:
  // `step` is the length of fluid steps [s].
  StabilityWatch(const Scene& scene, const CouplingPlan& plan,
                 std::vector<std::optional<WetSurface>> surfaces, double step);

  // A look is due after the first step of every output interval, where a run may be resumed, and every eighth
  // step.
  [[nodiscard]] bool is_due(std::uint64_t step, const protocol::StepClock& clock) const;
  // Throws Stop where the scene says so.
  void look(const std::vector<double>& liquid, std::span<const fluid::Kinematics> bodies, double time);
  // Of an exchange that ended at `time`.
  void note(const Accepted& accepted, double time);

  // At the last look, see BodyStability.indicator.
  [[nodiscard]] std::span<const double> indicators() const { return indicators_; }
  // Takes back the looks of an exchange that is repeated.
  void save() { saved_ = indicators_; }
  void restore() { indicators_ = saved_; }

 private:
  void tell(const std::string& what) const;

  const Scene& scene_;
  const CouplingPlan& plan_;
  std::vector<std::optional<WetSurface>> surfaces_;
  double exchange_;  // [s]
  std::vector<double> indicators_, saved_;
  std::vector<bool> told_;  // of every body
  bool told_of_iterations_ = false;
};

}  // namespace sluice::server
