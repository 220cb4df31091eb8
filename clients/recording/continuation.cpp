#include "clients/recording/continuation.hpp"

#include <fmt/format.h>

#include "clients/recording/copy.hpp"
#include "protocol/error.hpp"

namespace sluice::clients {
namespace {

namespace fs = std::filesystem;
using protocol::InputError;

Extent extent_at(std::uint64_t step, const Welcome& welcome) {
  return {step / welcome.steps_per_interval() + 1, welcome.scene().body_size() > 0 ? step : 0};
}

void require_reaches(const Reader& recording, const std::string& run_id, const Extent& extent,
                     std::uint64_t step) {
  const std::string name = recording.path().string();
  if (recording.run_id() != run_id)
    throw InputError(fmt::format(
        "{} is the recording of run {}, the checkpoint is of run {}; name the recording that belongs to it",
        name, recording.run_id(), run_id));
  if (recording.frames() < extent.frames || recording.exchanges() < extent.exchanges)
    throw InputError(
        fmt::format("{} holds {} frames and {} exchanges, the run goes on after frame {} and step {}; resume "
                    "from a checkpoint "
                    "before that",
                    name, recording.frames(), recording.exchanges(), extent.frames - 1, step));
}

}  // namespace

Writer continue_recording(const fs::path& recording, const fs::path& output, bool force,
                          protocol::Message welcome) {
  Welcome& content = *welcome.header.mutable_welcome();
  const std::uint64_t step = content.done();
  const Extent extent = extent_at(step, content);
  content.clear_done();  // the file begins at time 0

  const bool in_place = fs::exists(output) && fs::equivalent(recording, output);
  if (is_being_written(recording))
    throw InputError(recording.string() + " is being written by another recorder; wait for its end");
  const fs::path target = in_place ? fs::path(output.string() + ".resumed") : output;
  const Reader reader(recording);
  require_reaches(reader, welcome.header.run_id(), extent, step);
  Writer writer(OutputFile(target, in_place || force), welcome);
  if (const Extent copied = copy_rows(reader, writer, extent); copied != extent) {
    fs::remove(target);
    throw InputError(
        fmt::format("{} is damaged after frame {}, before the checkpoint; resume from an earlier one",
                    recording.string(), copied.frames));
  }
  if (in_place) fs::rename(target, output);
  return writer;
}

}  // namespace sluice::clients
