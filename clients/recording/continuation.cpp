#include "clients/recording/continuation.hpp"

#include <fmt/format.h>

#include "clients/recording/copy.hpp"
#include "clients/recording/output_file.hpp"
#include "protocol/error.hpp"

namespace sluice::clients {
namespace {

namespace fs = std::filesystem;
using protocol::InputError;

// A frame at time 0 and at the end of every interval; exchanges in a scene with bodies.
Extent extent_at(std::uint64_t step, std::uint64_t steps_per_interval, const Scene& scene) {
  return {step / steps_per_interval + 1, scene.body_size() > 0 ? step : 0};
}

}  // namespace

void require_reaches(const Reader& recording, const std::string& run_id, std::uint64_t step,
                     std::uint64_t steps_per_interval) {
  const std::string name = recording.path().string();
  if (recording.run_id() != run_id)
    throw InputError(fmt::format(
        "{} is the recording of run {}, the checkpoint is of run {}; name the recording that belongs to it",
        name, recording.run_id(), run_id));
  const Extent extent = extent_at(step, steps_per_interval, recording.scene());
  if (recording.frames() < extent.frames || recording.exchanges() < extent.exchanges)
    throw InputError(
        fmt::format("{} holds {} frames and {} exchanges, the run goes on after frame {} and step {}; resume "
                    "from a checkpoint "
                    "before that",
                    name, recording.frames(), recording.exchanges(), extent.frames - 1, step));
}

Continuation::Continuation(const fs::path& recording, const fs::path& output, bool force,
                           protocol::Message welcome)
    : output_(output) {
  Welcome& content = *welcome.header.mutable_welcome();
  const std::uint64_t step = content.done();
  content.clear_done();  // the file begins at time 0
  if (is_being_written(recording))
    throw InputError(recording.string() + " is being written by another recorder; wait for its end");
  const bool in_place = fs::exists(output) && fs::equivalent(recording, output);
  if (in_place) aside_ = output.string() + ".resumed";

  const Reader reader(recording);
  require_reaches(reader, welcome.header.run_id(), step, content.steps_per_interval());
  const Extent extent = extent_at(step, content.steps_per_interval(), content.scene());
  writer_.emplace(OutputFile(in_place ? aside_ : output, in_place || force), welcome);
  const Extent copied = copy_rows(reader, *writer_, extent);
  if (copied == extent) return;
  abandon();
  throw InputError(
      fmt::format("{} is damaged after {} frames, before the checkpoint; resume from an earlier checkpoint",
                  recording.string(), copied.frames));
}

void Continuation::take_place() {
  if (aside_.empty()) return;
  fs::rename(aside_, output_);
  aside_.clear();
}

void Continuation::abandon() {
  writer_.reset();
  if (!aside_.empty()) fs::remove(aside_);
}

}  // namespace sluice::clients
