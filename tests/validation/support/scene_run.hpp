#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "clients/rigid/window.hpp"
#include "rigid/world.hpp"
#include "server/simulation.hpp"
#include "validation/support/case.hpp"

namespace sluice::validation {

// What a run measures beside the state.
enum class Walls { kNotMeasured, kForceMeasured };

// A scene run in this process: the server's simulation and the rigid process's world, coupled as the protocol
// couples them.
class SceneRun {
 public:
  // Overrides as for `sluice run --set`. Throws SceneError.
  explicit SceneRun(const std::filesystem::path& scene, const std::vector<std::string>& overrides = {},
                    int threads = 1, Walls walls = Walls::kNotMeasured);
  // A scene that is not in a file. Precondition: protocol::check_fields finds nothing.
  explicit SceneRun(const Scene& scene, int threads = 1, Walls walls = Walls::kNotMeasured);

  // Advances by one exchange (one fluid step unless the scene asks for more), or to the next output time;
  // false when the run is over. Throws server::Stop when the fluid has become unstable.
  bool next_step();
  bool next_output();
  [[nodiscard]] bool is_output() const { return simulation_.clock.is_output(step_); }

  [[nodiscard]] double time() const;  // [s]
  [[nodiscard]] double end_time() const;
  [[nodiscard]] const Scene& scene() const { return simulation_.scene; }
  [[nodiscard]] const fluid::Solver& solver() const { return *simulation_.solver; }
  [[nodiscard]] const server::Simulation& simulation() const { return simulation_; }
  [[nodiscard]] const rigid::World& world() const { return *world_; }
  // Iterations of all exchanges, and exchanges.
  [[nodiscard]] std::uint64_t iterations() const { return iterations_; }
  [[nodiscard]] std::uint64_t exchanges() const { return exchanges_; }
  // What the liquid gave to the walls and to the bodies since the start [N s], by the kicks of its steps. Of
  // the walls only where their force is measured.
  [[nodiscard]] const Eigen::Vector3d& wall_impulse() const { return wall_impulse_; }
  [[nodiscard]] const Eigen::Vector3d& body_impulse() const { return body_impulse_; }
  [[nodiscard]] double largest_residual() const { return largest_residual_; }
  // Of every fluid particle, in the order of snapshots [kg].
  [[nodiscard]] const std::vector<double>& masses() const { return masses_; }
  // Of a body at the present time, and the fluid's action on it.
  [[nodiscard]] const fluid::Kinematics& body(std::size_t b) const { return simulation_.bodies[b]; }
  [[nodiscard]] const fluid::Wrench& wrench(std::size_t b) const { return solver().wrenches()[b]; }

  // An outcome with what the stepping cost so far.
  [[nodiscard]] Outcome outcome(std::vector<Figure> figures, double error) const;

 private:
  void advance();
  void exchange();
  void set_bodies(const std::vector<rigid::Kinematics>& motion);
  void guard() const;

  server::Simulation simulation_;
  std::unique_ptr<rigid::World> world_;
  std::unique_ptr<clients::Window> window_;  // where a body is free
  std::vector<double> masses_;
  std::uint64_t step_ = 0;
  std::uint64_t iterations_ = 0, exchanges_ = 0;
  double largest_residual_ = 0;
  Eigen::Vector3d wall_impulse_ = Eigen::Vector3d::Zero(), body_impulse_ = Eigen::Vector3d::Zero();
  double seconds_ = 0;  // wall-clock time in advance()
};

}  // namespace sluice::validation
