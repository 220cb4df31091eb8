#include "clients/sluice/run.hpp"

#include <fmt/core.h>
#include <spdlog/spdlog.h>

#include <iostream>
#include <optional>

#include "clients/recording/continuation.hpp"
#include "clients/recording/output_file.hpp"
#include "clients/sluice/check.hpp"
#include "clients/sluice/endpoints.hpp"
#include "clients/sluice/session.hpp"
#include "protocol/checkpoint_file.hpp"
#include "protocol/sim_time.hpp"

namespace sluice::clients {
namespace {

namespace fs = std::filesystem;

// Where a run is watched: where the user said, or in a directory of its own that goes with this object.
class RunEndpoint {
 public:
  explicit RunEndpoint(const RunOptions& options) : text_(options.listen) {
    if (!text_.empty()) return;
    own_.emplace();
    text_ = own_->text();
  }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  std::optional<PrivateEndpoint> own_;
  std::string text_;
};

// Everything that can be wrong is tried before anything is started; OutputFile leaves nothing behind.
void require_runnable(const RunOptions& options, const std::string& endpoint) {
  const Estimate estimate = require_sound(options.check);
  if (!options.output.empty()) const OutputFile trial(options.output, options.force);
  require_free(protocol::Endpoint::parse(endpoint, !options.keys.empty()));
  spdlog::info("{}: {}", options.check.scene.string(), to_string(estimate));
}

// A script that asked for JSON gets its object also when nothing was started.
void print_refusal(const RunOptions& options, const std::string& reason) {
  Summary summary;
  summary.file = (options.resume.empty() ? options.check.scene : options.resume).string();
  summary.status = "BAD_INPUT";
  summary.detail = reason;
  summary.exit_code = protocol::kBadInput;
  std::cout << to_json(summary) << std::endl;
}

int follow(const RunOptions& options, const std::string& endpoint) {
  Session session(options, endpoint);
  const Summary summary = session.follow();
  std::cerr << session.failure_report();
  std::cout << (options.json ? to_json(summary) + "\n" : to_table(summary)) << std::flush;
  return summary.exit_code;
}

// Calls `action`; a script that asked for JSON is told of bad input, too.
template <typename Action>
int reported(const RunOptions& options, const Action& action) {
  try {
    return action();
  } catch (const protocol::InputError& error) {
    if (options.json) print_refusal(options, error.what());
    throw;
  }
}

// run.checkpoint and run.previous.checkpoint -> run.h5
fs::path recording_of(const fs::path& checkpoint) {
  fs::path base = fs::path(checkpoint).replace_extension();
  if (base.extension() == ".previous") base.replace_extension();
  return base.replace_extension(".h5");
}

// The recording so far and that to be written, from what the checkpoint and the user say.
void choose_recordings(const Checkpoint& checkpoint, RunOptions& options) {
  if (!checkpoint.recorded()) {
    if (!options.output.empty())
      throw protocol::InputError(
          fmt::format("{} is of a run that was not recorded; leave out -o", options.resume.string()));
    return;
  }
  if (options.recording.empty()) options.recording = recording_of(options.resume);
  if (options.output.empty()) options.output = options.recording;
  if (!fs::exists(options.recording))
    throw protocol::InputError(
        fmt::format("{}, the recording of the run so far, is missing; name it with --recording",
                    options.recording.string()));
  if (is_being_written(options.recording))
    throw protocol::InputError(options.recording.string() + " is still being written; stop that run first");
  require_reaches(Reader(options.recording), checkpoint.run_id(), checkpoint.step(),
                  checkpoint.steps_per_interval());
  if (options.output != options.recording) const OutputFile trial(options.output, options.force);
}

}  // namespace

fs::path checkpoint_of(const fs::path& recording) {
  return recording.empty() ? fs::path() : fs::path(recording).replace_extension(".checkpoint");
}

int run(const RunOptions& options) {
  return reported(options, [&] {
    const RunEndpoint endpoint(options);
    require_runnable(options, endpoint.text());
    return follow(options, endpoint.text());
  });
}

int resume(RunOptions options) {
  return reported(options, [&] {
    const Checkpoint checkpoint = protocol::read_checkpoint(options.resume).header;
    choose_recordings(checkpoint, options);
    const RunEndpoint endpoint(options);
    require_free(protocol::Endpoint::parse(endpoint.text(), !options.keys.empty()));
    spdlog::info("{}: goes on at {:g} s", options.resume.string(), protocol::seconds(checkpoint.time_ns()));
    return follow(options, endpoint.text());
  });
}

}  // namespace sluice::clients
