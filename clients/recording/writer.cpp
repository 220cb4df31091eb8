#include "clients/recording/writer.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "clients/recording/energy.hpp"
#include "clients/recording/layout.hpp"
#include "clients/recording/prologue.hpp"
#include "clients/recording/series.hpp"
#include "clients/recording/xdmf.hpp"
#include "protocol/sim_time.hpp"

namespace sluice::clients {
namespace {

using protocol::InputError;
using protocol::Message;
using protocol::ProtocolError;

h5::File create_file(const std::filesystem::path& path) {
  const h5::Properties access(H5Pcreate(H5P_FILE_ACCESS), "make file properties");
  h5::check(H5Pset_libver_bounds(access, H5F_LIBVER_V110, H5F_LIBVER_V110), "choose a file version");
  h5::check(H5Pset_file_locking(access, true, true), "choose file locking");
  return {H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access), "create the file"};
}

void check_array(const Message& message, int i, const std::string& name, const h5::Shape& expected) {
  const bool present = i < message.header.array_size();
  const Array& array = present ? message.header.array(i) : Array::default_instance();
  if (array.name() == name && array.type() == Array::FLOAT64 &&
      std::equal(array.shape().begin(), array.shape().end(), expected.begin(), expected.end()))
    return;
  throw ProtocolError(
      fmt::format("array {} must be {} of type FLOAT64 and shape [{}], not {} of type {} and shape [{}]", i,
                  name, fmt::join(expected, ", "), present ? array.name() : "absent",
                  Array::Type_Name(array.type()), fmt::join(array.shape(), ", ")));
}

}  // namespace

class Writer::File {
 public:
  File(OutputFile output, const Message& welcome)
      : output_(std::move(output)),
        clock_(welcome.header.welcome().interval_ns(), welcome.header.welcome().steps_per_interval(),
               welcome.header.welcome().steps()),
        bodies_(static_cast<hsize_t>(welcome.header.welcome().scene().body_size())),
        frame_fields_(layout::frame_fields(welcome.header.welcome().fluid_particles(), bodies_)),
        exchange_fields_(layout::exchange_fields(bodies_)) {
    file_ = create_file(output_.path());
    write_prologue(file_, welcome);
    create_frames();
    create_exchange();
    h5::check(H5Fstart_swmr_write(file_), "start single-writer multiple-reader mode");
    flush();
    output_.keep();
  }

  void write_frame(const Message& message) {
    const Header& header = message.header;
    check_frame(message);
    for (std::size_t i = 0; i < frame_fields_.size(); ++i)
      frame_data_[i].append(message.array<double>(frame_fields_[i].array));
    const auto observables = layout::observables();
    for (std::size_t i = 0; i < observables.size(); ++i) {
      const auto values = energy_values(header.frame().energy(), observables[i].name, 3);
      energy_[i].append(std::span<const double>(values));
    }
    append_one<std::uint64_t>(frame_hash_, header.frame().hash());
    append_one<std::int64_t>(frame_time_ns_, header.time_ns());
    append_one<double>(frame_time_, protocol::seconds(header.time_ns()));
    append_one<std::uint64_t>(frame_step_, header.step());
  }

  void write_exchange(const Message& message) {
    const ExchangeLog& log = message.header.exchange_log();
    check_exchange(message);
    for (std::size_t i = 0; i < exchange_fields_.size(); ++i)
      exchange_data_[i].append(message.array<double>(exchange_fields_[i].array));
    std::vector<std::int64_t> times;
    std::vector<std::uint64_t> steps;
    for (std::uint64_t step = log.first_step(); step < log.first_step() + log.count(); ++step) {
      times.push_back(clock_.time(step));
      steps.push_back(step);
    }
    exchange_time_ns_.append(std::span<const std::int64_t>(times));
    exchange_step_.append(std::span<const std::uint64_t>(steps));
  }

  void flush() { h5::check(H5Fflush(file_, H5F_SCOPE_GLOBAL), "flush the file"); }

  // Under SWMR nothing may be added, but attributes of the same size may be written again.
  void finish(const std::string& reason, const std::string& detail, double wall_seconds) {
    flush();
    h5::rewrite_attribute(file_, "/status", "wall_seconds", fmt::format("{:.3f}", wall_seconds));
    h5::rewrite_attribute(file_, "/status", "detail", detail);
    h5::rewrite_attribute(file_, "/status", "reason", reason);
    flush();
    close();
  }

  [[nodiscard]] const std::filesystem::path& path() const { return output_.path(); }
  [[nodiscard]] std::uint64_t frames() const { return frame_step_.length(); }
  [[nodiscard]] std::uint64_t exchanges() const { return exchange_step_.length(); }

 private:
  template <typename T>
  static void append_one(h5::Series& series, T value) {
    series.append(std::span<const T>(&value, 1));
  }

  // Every element of H5MD has its own step and time; they are the same datasets by hard links.
  void link_frame_times(const std::string& group) {
    h5::link(file_, layout::kFrameStep, group + "/step");
    h5::link(file_, layout::kFrameTime, group + "/time");
  }

  void create_frames() {
    frame_step_ = h5::Series::create<std::uint64_t>(file_, layout::kFrameStep, {}, "");
    frame_time_ = h5::Series::create<double>(file_, layout::kFrameTime, {}, "s");
    frame_time_ns_ = h5::Series::create<std::int64_t>(file_, layout::kFrameTimeNs, {}, "ns");
    frame_hash_ = h5::Series::create<std::uint64_t>(file_, layout::kFrameHash, {}, "");
    link_frame_times("/frames");
    for (const auto& field : frame_fields_)
      frame_data_.push_back(h5::Series::create<double>(file_, field.dataset, field.row, field.unit));
    for (const char* name : {"velocity", "density", "pressure"}) {
      h5::link(file_, layout::kFrameStep, fmt::format("/particles/fluid/{}/step", name));
      h5::link(file_, layout::kFrameTime, fmt::format("/particles/fluid/{}/time", name));
    }
    for (const auto& observable : layout::observables()) {
      energy_.push_back(h5::Series::create<double>(file_, layout::energy_group(observable) + "/value",
                                                   observable.row, observable.unit));
      link_frame_times(layout::energy_group(observable));
    }
  }

  void create_exchange() {
    exchange_step_ = h5::Series::create<std::uint64_t>(file_, layout::kExchangeStep, {}, "");
    exchange_time_ns_ = h5::Series::create<std::int64_t>(file_, layout::kExchangeTimeNs, {}, "ns");
    for (const auto& field : exchange_fields_)
      exchange_data_.push_back(h5::Series::create<double>(file_, field.dataset, field.row, field.unit));
  }

  void check_frame(const Message& message) const {
    for (std::size_t i = 0; i < frame_fields_.size(); ++i)
      check_array(message, static_cast<int>(i), frame_fields_[i].array, frame_fields_[i].row);
    const Frame& frame = message.header.frame();
    if (frame.index() != frames())
      throw ProtocolError(fmt::format("frame {} came, expected {}", frame.index(), frames()));
    if (frame.hash() != message.hash_arrays())
      throw ProtocolError(fmt::format("frame {} does not have the hash it announces", frame.index()));
    if (bodies_ > 0 && message.header.step() > exchanges())
      throw ProtocolError(fmt::format("frame {} of step {} came before the exchanges of steps {} and on",
                                      frame.index(), message.header.step(), exchanges() + 1));
  }

  void check_exchange(const Message& message) const {
    const ExchangeLog& log = message.header.exchange_log();
    for (std::size_t i = 0; i < exchange_fields_.size(); ++i) {
      h5::Shape shape = exchange_fields_[i].row;
      shape.insert(shape.begin(), log.count());
      check_array(message, static_cast<int>(i), exchange_fields_[i].array, shape);
    }
    if (log.first_step() != exchanges() + 1)
      throw ProtocolError(fmt::format("exchanges from step {} came, expected from step {}", log.first_step(),
                                      exchanges() + 1));
  }

  // The datasets before the file: the file stays open while one of them is.
  void close() {
    const auto close_all = [](auto&... series) { (..., (series = {})); };
    close_all(frame_step_, frame_time_, frame_time_ns_, frame_hash_, exchange_step_, exchange_time_ns_);
    frame_data_.clear();
    energy_.clear();
    exchange_data_.clear();
    file_.reset("close the file");
  }

  OutputFile output_;
  protocol::StepClock clock_;
  hsize_t bodies_;
  std::vector<layout::Field> frame_fields_, exchange_fields_;
  h5::File file_;
  h5::Series frame_step_, frame_time_, frame_time_ns_, frame_hash_;
  h5::Series exchange_step_, exchange_time_ns_;
  std::vector<h5::Series> frame_data_, energy_, exchange_data_;
};

Writer::Writer(OutputFile file, const Message& welcome) {
  h5::silence();
  if (!welcome.header.has_welcome()) throw ProtocolError("a recording starts with a Welcome");
  const std::string name = file.path().string();
  try {
    file_ = std::make_unique<File>(std::move(file), welcome);
  } catch (const h5::Error& error) {
    throw InputError(fmt::format("{}: {}", name, error.what()));
  } catch (const std::invalid_argument& error) {
    throw ProtocolError(fmt::format("the Welcome's clock is not usable: {}", error.what()));
  }
}

Writer::~Writer() = default;
Writer::Writer(Writer&&) noexcept = default;

void Writer::write(const Message& message) {
  switch (message.header.content_case()) {
    case Header::kFrame:
      return file_->write_frame(message);
    case Header::kExchangeLog:
      return file_->write_exchange(message);
    default:
      throw ProtocolError("only frames and exchanges are recorded");
  }
}

void Writer::flush() {
  file_->flush();
}

void Writer::finish(const std::string& reason, const std::string& detail, double wall_seconds) {
  file_->finish(reason, detail, wall_seconds);
  write_xdmf(file_->path());
}

std::uint64_t Writer::frames() const {
  return file_->frames();
}
std::uint64_t Writer::exchanges() const {
  return file_->exchanges();
}

}  // namespace sluice::clients
