// Coupling: the state of both sides, kept and written.

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "server/coupling.hpp"

namespace sluice::server {

using protocol::Message;

void Coupling::checkpoint(std::uint64_t step) {
  if (!has_checkpoints() || (lock_step_ && !gives_state_)) return;
  if (lock_step_)
    wait_until([&] { return rigid_state_.step == step; }, options_.deadline,
               [&] {
                 const std::string what =
                     fmt::format("the rigid process did not give its state after step {}", step);
                 return Stop(End::PARTICIPANT_TIMEOUT, late(what, options_.deadline));
               });
  checkpoints_.keep(step, session_.run_id(), rigid_state_.numbers, rigid_state_.build);
  kept_after_ = recorder_.sent();
  if (!checkpoints_.is_due()) return;
  if (options_.expect_recorder) drain_recorder();
  write_checkpoint();
}

// The state that a run stopped with: that of the last output.
void Coupling::write_last_checkpoint(Outcome& outcome) {
  const bool recorded = recorder_.acknowledged() >= kept_after_;
  if (recorded && checkpoints_.is_due_at_end(outcome.reason == End::FINISHED)) write_checkpoint();
  if (const std::string report = checkpoints_.report(); !report.empty()) outcome.detail += "; " + report;
}

// A full disk is no reason to lose the run.
void Coupling::write_checkpoint() {
  try {
    checkpoints_.write();
  } catch (const std::system_error& error) {
    spdlog::warn("no checkpoint after step {}: {}", checkpoints_.step(), error.what());
  }
}

void Coupling::take_state(const Message& message) {
  const State& content = message.header.state();
  if (!lock_step_ || content.step() != step_ || !simulation_.clock.is_output(step_))
    throw Refused(Refusal::BAD_SEQUENCE,
                  fmt::format("the state after step {} came; it is wanted after output steps, and {} is done",
                              content.step(), step_));
  try {
    const std::span<const double> numbers = message.array<double>("state");
    rigid_state_ = {content.step(), content.build(), {numbers.begin(), numbers.end()}};
  } catch (const protocol::ProtocolError& error) {
    throw Refused(Refusal::BAD_MESSAGE, error.what());
  }
}

}  // namespace sluice::server
