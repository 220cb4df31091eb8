#pragma once

#include <memory>
#include <string>
#include <vector>

#include "rigid/world.hpp"
#include "server/simulation.hpp"

namespace sluice::validation {

// A scene of clients/scenes run in this process: the server's simulation and the rigid process's world,
// coupled as the protocol couples them.
class SceneRun {
 public:
  // `scene` without ending, e.g. "dam_break"; overrides as for `sluice run --set`.
  explicit SceneRun(const std::string& scene, const std::vector<std::string>& overrides = {},
                    int threads = 1);

  // Advances by one fluid step, or to the next output time; false when the run is over.
  bool next_step();
  bool next_output();
  [[nodiscard]] bool is_output() const { return simulation_.clock.is_output(step_); }

  [[nodiscard]] double time() const;  // [s]
  [[nodiscard]] double end_time() const;
  [[nodiscard]] const Scene& scene() const { return simulation_.scene; }
  [[nodiscard]] const fluid::Solver& solver() const { return *simulation_.solver; }
  // Of a body at the present time, and the fluid's action on it.
  [[nodiscard]] const fluid::Kinematics& body(std::size_t b) const { return simulation_.bodies[b]; }
  [[nodiscard]] const fluid::Wrench& wrench(std::size_t b) const { return solver().wrenches()[b]; }

 private:
  server::Simulation simulation_;
  std::unique_ptr<rigid::World> world_;
  std::uint64_t step_ = 0;
};

// Where a case leaves its figures: the build tree's validation folder.
std::string result_file(const std::string& name);

}  // namespace sluice::validation
