#include "validation/support/scene_run.hpp"

#include <chrono>

#include "clients/rigid/convert.hpp"
#include "protocol/scene_file.hpp"
#include "server/guard.hpp"

namespace sluice::validation {

namespace {

constexpr std::uint64_t kGuardInterval = 8;  // [steps], as in the server

server::Simulation simulate(const Scene& scene, int threads, Walls walls) {
  return server::make_simulation(scene, threads, [walls](fluid::Setup setup) {
    setup.measure_wall_force = walls == Walls::kForceMeasured;
    return fluid::make_solver(setup);
  });
}

// Particles start with one volume and the density that their pressure makes.
std::vector<double> initial_masses(const server::Simulation& simulation) {
  std::vector<double> masses = simulation.solver->snapshot().density;
  const double volume = simulation.particle_mass / simulation.scene.liquid().density();
  for (double& mass : masses) mass *= volume;
  return masses;
}

fluid::Kinematics to_fluid(const rigid::Kinematics& k) {
  return {k.position, k.orientation, k.velocity, k.angular_velocity, k.acceleration, k.angular_acceleration};
}

std::vector<rigid::Wrench> to_rigid(std::span<const fluid::Wrench> wrenches) {
  std::vector<rigid::Wrench> converted;
  for (const fluid::Wrench& w : wrenches) converted.push_back({w.force, w.moment});
  return converted;
}

}  // namespace

SceneRun::SceneRun(const std::filesystem::path& scene, const std::vector<std::string>& overrides, int threads,
                   Walls walls)
    : SceneRun(protocol::SceneFile::load(scene, overrides).scene(), threads, walls) {}

SceneRun::SceneRun(const Scene& scene, int threads, Walls walls)
    : simulation_(simulate(scene, threads, walls)), masses_(initial_masses(simulation_)) {
  if (simulation_.bodies.empty()) return;
  world_ = std::make_unique<rigid::World>(clients::to_world(simulation_.scene));
  world_->start(to_rigid(simulation_.initial_wrenches));
}

bool SceneRun::next_output() {
  while (next_step())
    if (is_output()) return true;
  return false;
}

bool SceneRun::next_step() {
  if (step_ >= simulation_.clock.steps()) return false;
  const auto start = std::chrono::steady_clock::now();
  advance();
  seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (step_ % kGuardInterval == 0 || is_output()) guard();
  return true;
}

void SceneRun::advance() {
  ++step_;
  const double dt = protocol::seconds(simulation_.clock.duration(step_));
  if (world_) {
    const auto predicted = world_->predict(time(), dt);
    for (std::size_t b = 0; b < predicted.size(); ++b) simulation_.bodies[b] = to_fluid(predicted[b]);
  }
  simulation_.solver->step(dt, simulation_.bodies);
  if (world_ && world_->has_free_bodies()) world_->correct(dt, to_rigid(simulation_.solver->wrenches()));
}

void SceneRun::guard() const {
  server::Guard(scene()).check(solver().snapshot(), time());
}

double SceneRun::time() const {
  return protocol::seconds(simulation_.clock.time(step_));
}
double SceneRun::end_time() const {
  return protocol::seconds(simulation_.clock.time(simulation_.clock.steps()));
}

Outcome SceneRun::outcome(std::vector<Figure> figures, double error) const {
  return {std::move(figures), error, seconds_, simulation_.fluid_particles, step_};
}

}  // namespace sluice::validation
