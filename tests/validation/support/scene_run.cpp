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
  const double volume = simulation.particle_masses[0] / simulation.scene.liquid().density();
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
  if (!world_->has_free_bodies()) return;
  std::vector<double> indicators;
  for (const BodyStability& body : simulation_.coupling.stability) indicators.push_back(body.indicator());
  window_ = std::make_unique<clients::Window>(*world_, simulation_.coupling.coupling,
                                              clients::to_vector(simulation_.scene.gravity()), indicators,
                                              to_rigid(simulation_.initial_wrenches));
}

bool SceneRun::next_output() {
  while (next_step())
    if (is_output()) return true;
  return false;
}

bool SceneRun::next_step() {
  if (step_ >= simulation_.clock.steps()) return false;
  const std::uint64_t before = step_;
  const auto start = std::chrono::steady_clock::now();
  advance();
  seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (step_ / kGuardInterval != before / kGuardInterval || is_output()) guard();
  return true;
}

void SceneRun::advance() {
  if (window_) return exchange();
  ++step_;
  const double dt = protocol::seconds(simulation_.clock.duration(step_));
  if (world_) set_bodies(world_->predict(time(), dt));
  simulation_.solver->step(dt, simulation_.bodies);
}

void SceneRun::set_bodies(const std::vector<rigid::Kinematics>& motion) {
  for (std::size_t b = 0; b < motion.size(); ++b) simulation_.bodies[b] = to_fluid(motion[b]);
}

void SceneRun::exchange() {
  const protocol::StepClock& clock = simulation_.clock;
  const sluice::Coupling& coupling = simulation_.coupling.coupling;
  const std::uint64_t first = step_ + 1;
  step_ = clock.exchange_end(first, coupling.steps_per_exchange());
  std::vector<clients::Window::Step> steps;
  for (std::uint64_t k = first; k <= step_; ++k)
    steps.push_back({protocol::seconds(clock.time(k)), protocol::seconds(clock.duration(k))});

  fluid::Solver& solver = *simulation_.solver;
  window_->begin(steps);
  if (coupling.scheme() == IMPLICIT) solver.save();
  std::vector<clients::Window::Wrenches> answer;
  Eigen::Vector3d on_walls, on_bodies;
  do {
    if (!answer.empty()) solver.restore();
    answer.clear();
    on_walls = on_bodies = Eigen::Vector3d::Zero();
    const auto motion = window_->predict();
    for (std::size_t k = 0; k < steps.size(); ++k) {
      set_bodies(motion[k]);
      const double half = 0.5 * steps[k].length;
      const auto add = [&] {
        on_walls += half * solver.wall_wrench().force;
        for (const fluid::Wrench& wrench : solver.wrenches()) on_bodies += half * wrench.force;
      };
      add();
      solver.step(steps[k].length, simulation_.bodies);
      add();
      answer.push_back(to_rigid(solver.wrenches()));
    }
  } while (!window_->accept(answer));
  wall_impulse_ += on_walls;
  body_impulse_ += on_bodies;
  ++exchanges_;
  iterations_ += static_cast<std::uint64_t>(window_->iterations());
  largest_residual_ = std::max(largest_residual_, window_->residual());
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
