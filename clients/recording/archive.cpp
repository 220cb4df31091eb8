#include "clients/recording/archive.hpp"

#include <fmt/format.h>

#include "clients/recording/copy.hpp"
#include "clients/recording/xdmf.hpp"
#include "protocol/error.hpp"

namespace sluice::clients {
namespace {

namespace fs = std::filesystem;
using protocol::InputError;

double megabytes(const fs::path& path) {
  return 1e-6 * static_cast<double>(fs::file_size(path));
}

void require_finished(const Reader& recording) {
  if (recording.ending() == Ending::kFinished) return;
  throw InputError(recording.path().string() +
                   (recording.ending() == Ending::kBeingWritten
                        ? " is being written; wait for its recorder to end"
                        : " was left by a recorder that was killed; make it whole with sluice repair"));
}

void copy_all(const Reader& recording, const fs::path& path, bool force) {
  Writer writer(OutputFile(path, force), recording.welcome_message(), h5::Storage::kCompressed);
  const Extent all{recording.frames(), recording.exchanges()};
  const bool whole = copy_rows(recording, writer, all) == all;
  writer.finish(recording.reason(), recording.detail(), recording.wall_seconds());
  if (whole) return;
  fs::remove(path);
  throw InputError(recording.path().string() + " is damaged; see what is left with sluice repair");
}

}  // namespace

std::string archive(const fs::path& recording, const fs::path& copy, bool force) {
  if (fs::exists(copy) && fs::equivalent(recording, copy))
    throw InputError(copy.string() + " is the recording itself; choose another name for the copy");
  const Reader reader(recording);
  require_finished(reader);
  copy_all(reader, copy, force);
  write_xdmf(copy);
  return fmt::format("{}: {:.1f} MB, {:.0f} % of {}\n", copy.string(), megabytes(copy),
                     100 * megabytes(copy) / megabytes(recording), recording.string());
}

}  // namespace sluice::clients
