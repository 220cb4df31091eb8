#pragma once

#include <chrono>
#include <filesystem>
#include <optional>

#include "protocol/checkpoint_file.hpp"
#include "server/simulation.hpp"

namespace sluice::server {

struct CheckpointOptions {
  std::filesystem::path file{};  // empty: none are written
  double every = 0;              // simulated [s]; 0: every five minutes of wall time
};

// The state at the last output, kept in memory, and the times at which it goes to disk. Knows no socket.
class Checkpoints {
 public:
  Checkpoints(const CheckpointOptions& options, const Simulation& simulation, bool recorded);

  [[nodiscard]] bool wanted() const { return !options_.file.empty(); }

  // The state between two exchanges; `rigid` is that of the bodies and of the program `rigid_build`.
  void keep(std::uint64_t step, const std::string& run_id, std::vector<double> rigid,
            const std::string& rigid_build);
  // Whether what was kept last ought to be on disk by now.
  [[nodiscard]] bool is_due() const;
  // Whether there is something to go on from at the end of a run that did all of its steps, or not.
  [[nodiscard]] bool is_due_at_end(bool finished) const;
  // The step that was kept last.
  [[nodiscard]] std::uint64_t step() const { return kept_ ? kept_->header.step() : 0; }
  // Throws std::system_error.
  void write();
  // "checkpoint at 0.2 s: out/run.checkpoint"; empty when none was written.
  [[nodiscard]] std::string report() const;

 private:
  using Clock = std::chrono::steady_clock;
  // Which of the intervals between checkpoints a time is in.
  [[nodiscard]] std::int64_t interval(std::int64_t time_ns) const;

  CheckpointOptions options_;
  const Simulation& simulation_;
  bool recorded_;
  std::optional<protocol::CheckpointFile> kept_;
  std::int64_t written_ns_;  // simulated
  std::uint64_t written_step_ = 0;
  Clock::time_point written_ = Clock::now();
};

}  // namespace sluice::server
