#include "server/checkpoints.hpp"

#include <fmt/format.h>

#include <cmath>

#include "protocol/build_id.hpp"
#include "server/build_info.hpp"

namespace sluice::server {

namespace {
constexpr std::chrono::minutes kEvery{5};
}  // namespace

Checkpoints::Checkpoints(const CheckpointOptions& options, const Simulation& simulation, bool recorded)
    : options_(options),
      simulation_(simulation),
      recorded_(recorded),
      written_ns_(simulation.clock.time(simulation.resumed.step)) {}

void Checkpoints::keep(std::uint64_t step, const std::string& run_id, std::vector<double> rigid,
                       const std::string& rigid_build) {
  if (!kept_) kept_.emplace();
  Checkpoint& header = kept_->header;
  header.Clear();
  *header.mutable_scene() = simulation_.scene;
  header.mutable_scene()->set_duration(std::max(simulation_.whole_duration, simulation_.scene.duration()));
  header.set_run_id(run_id);
  header.set_step(step);
  header.set_time_ns(simulation_.clock.time(step));
  header.set_interval_ns(simulation_.clock.interval());
  header.set_steps_per_interval(simulation_.clock.steps_per_interval());
  header.set_server_build(protocol::build_id());
  header.set_processor_class(processor_class());
  header.set_rigid_build(rigid_build);
  header.set_version(build_info(simulation_.threads).version());
  header.set_recorded(recorded_);
  kept_->rigid = std::move(rigid);
  simulation_.solver->write_state(kept_->fluid);
}

std::int64_t Checkpoints::interval(std::int64_t time_ns) const {
  return static_cast<std::int64_t>(std::floor(1e-9 * static_cast<double>(time_ns) / options_.every + 1e-9));
}

bool Checkpoints::is_due() const {
  if (options_.every > 0) return interval(kept_->header.time_ns()) > interval(written_ns_);
  return Clock::now() - written_ >= kEvery;
}

bool Checkpoints::is_due_at_end(bool finished) const {
  if (!kept_ || kept_->header.step() == written_step_) return false;
  return !finished || options_.every > 0 || simulation_.whole_duration > simulation_.scene.duration();
}

void Checkpoints::write() {
  protocol::write_checkpoint(options_.file, *kept_);
  written_ns_ = kept_->header.time_ns();
  written_step_ = kept_->header.step();
  written_ = Clock::now();
}

std::string Checkpoints::report() const {
  if (written_step_ == 0) return {};
  return fmt::format("checkpoint at {:g} s: {}", protocol::seconds(written_ns_), options_.file.string());
}

}  // namespace sluice::server
