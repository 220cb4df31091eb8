#include "clients/recording/repair.hpp"

#include <fmt/format.h>

#include "clients/recording/output_file.hpp"
#include "clients/recording/xdmf.hpp"
#include "protocol/error.hpp"

namespace sluice::clients {
namespace {

namespace fs = std::filesystem;
using protocol::InputError;

bool reads(const Reader& recording) {
  try {
    for (std::uint64_t index = 0; index < recording.frames(); ++index) (void)recording.frame(index);
    constexpr std::uint64_t kAtOnce = 256;
    for (std::uint64_t done = 0; done < recording.exchanges(); done += kAtOnce)
      (void)recording.exchange_log(
          done + 1, static_cast<std::uint32_t>(std::min(kAtOnce, recording.exchanges() - done)));
    return true;
  } catch (const InputError&) {
    return false;
  }
}

fs::path damaged_name(const fs::path& recording) {
  return fs::path(recording).replace_extension(".damaged" + recording.extension().string());
}

void require_absent(const fs::path& path) {
  if (fs::exists(path))
    throw InputError(
        fmt::format("{} exists already; move it away, or choose a name for the repaired "
                    "recording with -o",
                    path.string()));
}

// How the recording ended, in the repaired one.
std::string reason_of(const Reader& recording) {
  return recording.ending() == Ending::kCutShort ? "recorder killed" : recording.reason();
}

Extent rewrite(const Reader& recording, const fs::path& path, bool force, const Extent& extent) {
  Writer writer(OutputFile(path, force), recording.welcome_message());
  const Extent kept = copy_rows(recording, writer, extent);
  const std::string lost = kept == extent ? "" : fmt::format(" of {}", extent.frames);
  writer.finish(reason_of(recording),
                fmt::format("{}{}repaired: {}{} frames", recording.detail(),
                            recording.detail().empty() ? "" : "; ", kept.frames, lost),
                recording.wall_seconds());
  return kept;
}

}  // namespace

Repair repair(const fs::path& recording, const fs::path& output) {
  const fs::path damaged = damaged_name(recording);
  if (is_being_written(recording))
    throw InputError(recording.string() + " is being written; wait for its recorder to end");
  Repair result;
  {
    const Reader reader(recording);
    result.found = result.kept = {reader.frames(), reader.exchanges()};
    if (reader.ending() == Ending::kFinished && reads(reader)) return result;
    if (output.empty()) require_absent(damaged);
    result.repaired = output.empty() ? fs::path(recording.string() + ".repaired") : output;
    result.kept = rewrite(reader, result.repaired, output.empty(), result.found);
  }
  result.original = recording;
  if (output.empty()) {
    fs::rename(recording, damaged);
    fs::rename(result.repaired, recording);
    result.original = damaged;
    result.repaired = recording;
  }
  write_xdmf(result.repaired);
  return result;
}

std::string to_text(const Repair& repair, const fs::path& recording) {
  if (repair.repaired.empty())
    return fmt::format("{} is whole: {} frames, {} exchanges\n", recording.string(), repair.found.frames,
                       repair.found.exchanges);
  return fmt::format("{}: {} of {} frames, {} of {} exchanges; what was found is kept as {}\n",
                     repair.repaired.string(), repair.kept.frames, repair.found.frames, repair.kept.exchanges,
                     repair.found.exchanges, repair.original.string());
}

}  // namespace sluice::clients
