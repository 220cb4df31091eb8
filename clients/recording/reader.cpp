#include "clients/recording/reader.hpp"

#include <fmt/format.h>

#include <charconv>
#include <optional>

#include "clients/recording/exchange_table.hpp"
#include "clients/recording/frame_table.hpp"
#include "clients/recording/layout.hpp"
#include "clients/recording/output_file.hpp"
#include "clients/recording/superblock.hpp"
#include "protocol/version.hpp"

namespace sluice::clients {
namespace {

using protocol::InputError;
using protocol::Message;

constexpr unsigned kReadAttempts = 25;

// A file whose writer is alive or was killed is read as if the writer were alive: that overlooks the mark
// that it left and an end that was never written, and changes nothing in the file.
h5::File open_file(const std::filesystem::path& path) {
  const h5::Properties access(H5Pcreate(H5P_FILE_ACCESS), "make file properties");
  h5::check(H5Pset_file_locking(access, true, true), "choose file locking");
  // A writer may be in the middle of a change: the library tries again, waiting 1, 2, 4 ... ns, 0.1 s in all.
  // By default it would wait for years in a damaged file.
  h5::check(H5Pset_metadata_read_attempts(access, kReadAttempts), "limit attempts to read");
  return {H5Fopen(path.c_str(), H5F_ACC_RDONLY | H5F_ACC_SWMR_READ, access), "open the file"};
}

void require_usable(const Superblock& start, bool live, const std::string& name) {
  if (!start.open_for_writing || start.open_for_swmr) return;
  throw InputError(name + (live ? " is only being set up by its recorder; try again in a moment"
                                : " was left by a recorder killed before the run began; it holds nothing"));
}

void require_recording(hid_t file, const std::string& name) {
  if (!h5::exists(file, "/h5md/creator") || !h5::exists(file, "/parameters/welcome") ||
      h5::attribute(file, "/h5md/creator", "name") != layout::kCreator)
    throw InputError(name + " is an HDF5 file, but not a recording of sluice");
  const int format = h5::integer(file, "/parameters", "format");
  if (format < 1 || format > layout::kFormat)
    throw InputError(
        fmt::format("{} is a recording of format {}, this program reads format 1 to {}; use the version of "
                    "sluice that wrote it ({})",
                    name, format, layout::kFormat, h5::attribute(file, "/h5md/creator", "version")));
}

Welcome read_welcome(hid_t file) {
  const auto bytes =
      h5::read<std::uint8_t>(file, "/parameters/welcome", h5::shape_at(file, "/parameters/welcome"));
  Welcome welcome;
  if (!welcome.ParseFromArray(bytes.data(), static_cast<int>(bytes.size())))
    throw h5::Error("/parameters/welcome is no message");
  welcome.clear_publish_endpoint();
  welcome.clear_record_endpoint();
  return welcome;
}

// Of a recording before format 3, where what joints gave counts as contact, and no stability is known.
Message as_format_3(const Message& log) {
  Message result;
  result.header = log.header;
  result.header.clear_array();
  for (const Array& array : log.header.array()) {
    const auto values = log.array<double>(array.name());
    if (array.name() != "ledger") {
      result.add_array<double>(array.name(), values, {array.shape().begin(), array.shape().end()});
      continue;
    }
    const std::uint64_t steps = array.shape(0), bodies = array.shape(1), had = array.shape(2), has = 29;
    std::vector<double> wide(steps * bodies * has, 0.0);
    for (std::size_t r = 0; r < steps * bodies; ++r)
      std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(r * had), had,
                  wide.begin() + static_cast<std::ptrdiff_t>(r * has));
    result.add_array<double>("ledger", wide, {steps, bodies, has});
    result.add_array<double>("indicator", std::vector<double>(steps * bodies, 0.0), {steps, bodies});
  }
  return result;
}

double number(const std::string& text) {
  double value = 0;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

}  // namespace

class Reader::File {
 public:
  explicit File(const std::filesystem::path& recording) : path(recording) {
    const bool live = is_being_written(path);
    const Superblock start = read_superblock(path);
    require_usable(start, live, path.string());
    file = open_file(path);
    require_recording(file, path.string());
    reason = h5::attribute(file, "/status", "reason");
    detail = h5::attribute(file, "/status", "detail");
    wall_seconds = number(h5::attribute(file, "/status", "wall_seconds"));
    const bool finished = reason != layout::kRunning;
    if (finished && start.cut_short)
      throw InputError(path.string() +
                       " is cut short: its end is missing; copy it again from where it was recorded");
    ending = finished ? Ending::kFinished : live ? Ending::kBeingWritten : Ending::kCutShort;
    run_id = h5::read_text(file, "/parameters/run_id");
    welcome = read_welcome(file);
    open_tables();
  }

  [[nodiscard]] Message signed_message(Message message) const {
    message.header.set_protocol_version(protocol::kProtocolVersion);
    message.header.set_run_id(run_id);
    return message;
  }

  void require_frame(std::uint64_t index) const {
    if (index < frames) return;
    throw InputError(frames == 0 ? path.string() + " holds no frame"
                                 : fmt::format("{} has no frame {}; choose one of 0 to {}", path.string(),
                                               index, frames - 1));
  }

  std::filesystem::path path;
  h5::File file;
  Ending ending = Ending::kFinished;
  std::string reason, detail, run_id;
  double wall_seconds = 0;
  Welcome welcome;
  std::uint64_t frames = 0, exchanges = 0;
  std::optional<FrameTable> frame_table;
  std::optional<ExchangeTable> exchange_table;

 private:
  // The last rows of a file that was not closed may never have been written; then they read as zeros, which
  // do not have the checksum zero.
  void open_tables() {
    const auto bodies = static_cast<hsize_t>(welcome.scene().body_size());
    frame_table = FrameTable::open(file, welcome);
    exchange_table = ExchangeTable::open(file, bodies, h5::integer(file, "/parameters", "format"));
    frames = frame_table->length();
    exchanges = exchange_table->length();
    if (ending == Ending::kFinished) return;
    while (exchanges > 0 && !exchange_table->intact(exchange_table->read(exchanges, 1))) --exchanges;
    while (frames > 0 && !is_complete(frame_table->read(frames - 1))) --frames;
  }

  [[nodiscard]] bool is_complete(const Message& frame) const {
    const bool exchanged = welcome.scene().body_size() == 0 || frame.header.step() <= exchanges;
    return exchanged && frame_table->intact(frame);
  }
};

namespace {

// Whatever HDF5 cannot read in a file is reported as damage of that file.
template <typename Action>
auto reading(const std::filesystem::path& path, Action action) {
  try {
    return action();
  } catch (const h5::Error& error) {
    throw InputError(fmt::format("{} is damaged or cut short: {}", path.string(), error.what()));
  }
}

}  // namespace

Reader::Reader(const std::filesystem::path& path) {
  h5::silence();
  file_ = reading(path, [&] { return std::make_unique<File>(path); });
}

Reader::~Reader() = default;
Reader::Reader(Reader&&) noexcept = default;

const std::filesystem::path& Reader::path() const {
  return file_->path;
}
Ending Reader::ending() const {
  return file_->ending;
}
const std::string& Reader::reason() const {
  return file_->reason;
}
const std::string& Reader::detail() const {
  return file_->detail;
}
double Reader::wall_seconds() const {
  return file_->wall_seconds;
}
const std::string& Reader::run_id() const {
  return file_->run_id;
}
const Welcome& Reader::welcome() const {
  return file_->welcome;
}
std::uint64_t Reader::frames() const {
  return file_->frames;
}
std::uint64_t Reader::exchanges() const {
  return file_->exchanges;
}

Header Reader::frame_header(std::uint64_t index) const {
  file_->require_frame(index);
  return reading(path(), [&] { return file_->frame_table->header(index); });
}

std::uint64_t Reader::particles(std::uint64_t index) const {
  file_->require_frame(index);
  return reading(path(), [&] { return file_->frame_table->particles(index); });
}

std::uint64_t Reader::slots() const {
  return file_->frame_table->slots();
}

Message Reader::frame(std::uint64_t index) const {
  file_->require_frame(index);
  return reading(path(), [&] {
    Message message = file_->frame_table->read(index);
    if (!file_->frame_table->intact(message))
      throw h5::Error(fmt::format("frame {} is not what was written", index));
    return file_->signed_message(std::move(message));
  });
}

Message Reader::welcome_message() const {
  return reading(path(), [&] {
    Message message;
    *message.header.mutable_welcome() = file_->welcome;
    const auto add = [&]<typename T>(T /*element*/, const char* array, const char* dataset) {
      const h5::Shape shape = h5::shape_at(file_->file, dataset);
      message.add_array<T>(array, h5::read<T>(file_->file, dataset, shape), {shape.begin(), shape.end()});
    };
    add(double{}, "wall/position", "/particles/wall/position");
    add(double{}, "boundary/position", "/particles/boundary/position");
    add(std::int32_t{}, "boundary/body", "/particles/boundary/body");
    return file_->signed_message(std::move(message));
  });
}

Message Reader::exchange_log(std::uint64_t first_step, std::uint32_t count) const {
  if (first_step < 1 || count > exchanges() || first_step - 1 > exchanges() - count)
    throw std::out_of_range(
        fmt::format("exchanges of {} steps from step {}, there are {}", count, first_step, exchanges()));
  return reading(path(), [&] {
    Message message = file_->exchange_table->read(first_step, count);
    if (!file_->exchange_table->intact(message))
      throw h5::Error(fmt::format("the exchanges of steps {} to {} are not what was written", first_step,
                                  first_step + count - 1));
    const int format = h5::integer(file_->file, "/parameters", "format");
    return file_->signed_message(format < 3 ? as_format_3(message) : std::move(message));
  });
}

}  // namespace sluice::clients
