#include "validation/support/scene_run.hpp"

#include "clients/rigid/convert.hpp"
#include "protocol/scene_check.hpp"
#include "protocol/scene_file.hpp"

namespace sluice::validation {

namespace {

Scene load(const std::string& scene, const std::vector<std::string>& overrides) {
  const std::string path = std::string(SLUICE_SOURCE) + "/clients/scenes/" + scene + ".scene";
  return protocol::with_defaults(protocol::SceneFile::load(path, overrides).scene());
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

SceneRun::SceneRun(const std::string& scene, const std::vector<std::string>& overrides, int threads)
    : simulation_(server::make_simulation(load(scene, overrides), threads)) {
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
  ++step_;
  const double dt = protocol::seconds(simulation_.clock.duration(step_));
  if (world_) {
    const auto predicted = world_->predict(time(), dt);
    for (std::size_t b = 0; b < predicted.size(); ++b) simulation_.bodies[b] = to_fluid(predicted[b]);
  }
  simulation_.solver->step(dt, simulation_.bodies);
  if (world_ && world_->has_free_bodies()) world_->correct(dt, to_rigid(simulation_.solver->wrenches()));
  return true;
}

double SceneRun::time() const {
  return protocol::seconds(simulation_.clock.time(step_));
}
double SceneRun::end_time() const {
  return protocol::seconds(simulation_.clock.time(simulation_.clock.steps()));
}

std::string result_file(const std::string& name) {
  return std::string(SLUICE_RESULTS) + "/" + name;
}

}  // namespace sluice::validation
