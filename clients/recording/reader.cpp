#include "clients/recording/reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "clients/recording/energy.hpp"
#include "clients/recording/layout.hpp"
#include "clients/recording/output_file.hpp"
#include "clients/recording/series.hpp"
#include "clients/recording/superblock.hpp"
#include "protocol/version.hpp"

namespace sluice::clients {
namespace {

using protocol::InputError;
using protocol::Message;

// A file whose writer is alive or was killed is read as if the writer were alive: that ignores the mark that
// it left, and changes nothing in the file.
h5::File open_file(const std::filesystem::path& path, FileState state) {
  const h5::Properties access(H5Pcreate(H5P_FILE_ACCESS), "make file properties");
  h5::check(H5Pset_file_locking(access, true, true), "choose file locking");
  const unsigned mode =
      state == FileState::kOpenForSwmr ? H5F_ACC_RDONLY | H5F_ACC_SWMR_READ : H5F_ACC_RDONLY;
  return {H5Fopen(path.c_str(), mode, access), "open the file"};
}

void require_recording(hid_t file, const std::string& name) {
  if (!h5::exists(file, "/h5md/creator") || !h5::exists(file, "/parameters/welcome") ||
      h5::attribute(file, "/h5md/creator", "name") != layout::kCreator)
    throw InputError(name + " is an HDF5 file, but not a recording of sluice");
  const int format = h5::integer(file, "/parameters", "format");
  if (format != layout::kFormat)
    throw InputError(
        fmt::format("{} is a recording of format {}, this program reads format {}; use the version of "
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
    const FileState state = file_state(path);
    if (state == FileState::kOpenForWriter) {
      throw InputError(path.string() +
                       (live ? " is only being set up by its recorder; try again in a moment"
                             : " was left by a recorder killed before the run began; it holds nothing"));
    }
    file = open_file(path, state);
    require_recording(file, path.string());
    reason = h5::attribute(file, "/status", "reason");
    detail = h5::attribute(file, "/status", "detail");
    wall_seconds = number(h5::attribute(file, "/status", "wall_seconds"));
    ending = reason != layout::kRunning ? Ending::kFinished
             : live                     ? Ending::kBeingWritten
                                        : Ending::kCutShort;
    run_id = h5::read_text(file, "/parameters/run_id");
    welcome = read_welcome(file);
    open_series();
    count();
  }

  [[nodiscard]] Message frame(std::uint64_t index) const {
    Message message = read_frame(index);
    if (message.header.frame().hash() != message.hash_arrays())
      throw InputError(
          fmt::format("{}: frame {} is damaged: its hash is not the recorded one", path.string(), index));
    return message;
  }

  [[nodiscard]] Instant instant(std::uint64_t index) const {
    require_frame(index);
    return {frame_step.read<std::uint64_t>(index, 1).front(),
            frame_time_ns.read<std::int64_t>(index, 1).front(),
            frame_hash.read<std::uint64_t>(index, 1).front()};
  }

  [[nodiscard]] Energy read_energy(std::uint64_t index) const {
    require_frame(index);
    Energy values;
    const auto observables = layout::observables();
    for (std::size_t i = 0; i < observables.size(); ++i)
      set_energy_values(values, observables[i].name, energy[i].read<double>(index, 1));
    return values;
  }

  [[nodiscard]] Message start_message() const {
    Message message;
    message.header.set_protocol_version(protocol::kProtocolVersion);
    message.header.set_run_id(run_id);
    return message;
  }

  std::filesystem::path path;
  h5::File file;
  Ending ending = Ending::kFinished;
  std::string reason, detail, run_id;
  double wall_seconds = 0;
  Welcome welcome;
  std::uint64_t frames = 0, exchanges = 0;

  std::vector<layout::Field> frame_fields, exchange_fields;
  h5::Series frame_step, frame_time_ns, frame_hash, exchange_step, exchange_time_ns;
  std::vector<h5::Series> frame_data, exchange_data, energy;

 private:
  void open_series() {
    const auto bodies = static_cast<hsize_t>(welcome.scene().body_size());
    frame_fields = layout::frame_fields(welcome.fluid_particles(), bodies);
    exchange_fields = layout::exchange_fields(bodies);
    frame_step = h5::Series::open(file, layout::kFrameStep, {});
    frame_time_ns = h5::Series::open(file, layout::kFrameTimeNs, {});
    frame_hash = h5::Series::open(file, layout::kFrameHash, {});
    exchange_step = h5::Series::open(file, layout::kExchangeStep, {});
    exchange_time_ns = h5::Series::open(file, layout::kExchangeTimeNs, {});
    for (const auto& field : frame_fields)
      frame_data.push_back(h5::Series::open(file, field.dataset, field.row));
    for (const auto& field : exchange_fields)
      exchange_data.push_back(h5::Series::open(file, field.dataset, field.row));
    for (const auto& observable : layout::observables())
      energy.push_back(h5::Series::open(file, layout::energy_group(observable) + "/value", observable.row));
  }

  // The shortest dataset counts. The last rows of a file that was not closed may never have been written;
  // then they read as zeros, which no frame's hash and no body's quaternion are.
  void count() {
    frames = std::min({frame_step.length(), frame_time_ns.length(), frame_hash.length()});
    exchanges = std::min(exchange_step.length(), exchange_time_ns.length());
    const auto shorten = [](std::uint64_t& length, const std::vector<h5::Series>& all) {
      for (const auto& series : all)
        if (!series.absent()) length = std::min<std::uint64_t>(length, series.length());
    };
    shorten(frames, frame_data);
    shorten(frames, energy);
    shorten(exchanges, exchange_data);
    if (ending == Ending::kFinished) return;
    while (exchanges > 0 && !exchange_is_written(exchanges)) --exchanges;
    while (frames > 0 && !frame_is_written(frames - 1)) --frames;
  }

  [[nodiscard]] bool exchange_is_written(std::uint64_t step) const {
    if (exchange_step.read<std::uint64_t>(step - 1, 1).front() != step) return false;
    if (exchange_data.front().absent()) return true;
    const auto row = exchange_data.front().read<double>(step - 1, 1);
    return std::any_of(row.begin() + 3, row.begin() + 7, [](double q) { return q != 0; });
  }

  [[nodiscard]] bool frame_is_written(std::uint64_t index) const {
    const Message message = read_frame(index);
    const bool follows = welcome.scene().body_size() == 0 || message.header.step() <= exchanges;
    return follows && message.header.frame().hash() == message.hash_arrays();
  }

  [[nodiscard]] Message read_frame(std::uint64_t index) const {
    require_frame(index);
    Message message = start_message();
    const Instant when = instant(index);
    message.header.set_step(when.step);
    message.header.set_time_ns(when.time_ns);
    Frame& frame = *message.header.mutable_frame();
    frame.set_index(index);
    frame.set_hash(when.hash);
    *frame.mutable_energy() = read_energy(index);
    for (std::size_t i = 0; i < frame_fields.size(); ++i) {
      const auto data = frame_data[i].read<double>(index, 1);
      message.add_array<double>(frame_fields[i].array, data,
                                {frame_fields[i].row.begin(), frame_fields[i].row.end()});
    }
    return message;
  }

  void require_frame(std::uint64_t index) const {
    if (index < frames) return;
    throw InputError(frames == 0 ? fmt::format("{} holds no frame", path.string())
                                 : fmt::format("{} has no frame {}; choose one of 0 to {}", path.string(),
                                               index, frames - 1));
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

Reader::Instant Reader::instant(std::uint64_t frame) const {
  return reading(path(), [&] { return file_->instant(frame); });
}

Energy Reader::energy(std::uint64_t frame) const {
  return reading(path(), [&] { return file_->read_energy(frame); });
}

Message Reader::frame(std::uint64_t index) const {
  return reading(path(), [&] { return file_->frame(index); });
}

Message Reader::welcome_message() const {
  return reading(path(), [&] {
    Message message = file_->start_message();
    *message.header.mutable_welcome() = file_->welcome;
    const auto add = [&]<typename T>(T /*element*/, const char* array, const char* dataset) {
      const h5::Shape shape = h5::shape_at(file_->file, dataset);
      const auto data = h5::read<T>(file_->file, dataset, shape);
      message.add_array<T>(array, data, {shape.begin(), shape.end()});
    };
    add(double{}, "wall/position", "/particles/wall/position");
    add(double{}, "boundary/position", "/particles/boundary/position");
    add(std::int32_t{}, "boundary/body", "/particles/boundary/body");
    return message;
  });
}

Message Reader::exchange_log(std::uint64_t first_step, std::uint32_t count) const {
  return reading(path(), [&] {
    if (first_step < 1 || count > exchanges() || first_step - 1 > exchanges() - count)
      throw std::out_of_range(
          fmt::format("exchanges {} to {} of {}", first_step, first_step + count - 1, exchanges()));
    Message message = file_->start_message();
    message.header.set_step(first_step + count - 1);
    if (count > 0)
      message.header.set_time_ns(
          file_->exchange_time_ns.read<std::int64_t>(first_step + count - 2, 1).front());
    message.header.mutable_exchange_log()->set_first_step(first_step);
    message.header.mutable_exchange_log()->set_count(count);
    for (std::size_t i = 0; i < file_->exchange_fields.size(); ++i) {
      const auto& field = file_->exchange_fields[i];
      const auto data = file_->exchange_data[i].read<double>(first_step - 1, count);
      std::vector<std::uint64_t> shape(field.row.begin(), field.row.end());
      shape.insert(shape.begin(), count);
      message.add_array<double>(field.array, data, shape);
    }
    return message;
  });
}

}  // namespace sluice::clients
