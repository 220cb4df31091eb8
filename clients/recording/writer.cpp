#include "clients/recording/writer.hpp"

#include <fmt/format.h>

#include <optional>

#include "clients/recording/exchange_table.hpp"
#include "clients/recording/frame_table.hpp"
#include "clients/recording/prologue.hpp"
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
  // A kill may end a write between two of the system's pages, and a block of metadata that is half old and
  // half new cannot be read. Where the file's space goes by pages, small blocks lie within one and large ones
  // begin one.
  const h5::Properties space(H5Pcreate(H5P_FILE_CREATE), "make file properties");
  h5::check(H5Pset_file_space_strategy(space, H5F_FSPACE_STRATEGY_PAGE, false, 1), "choose the file's space");
  h5::check(H5Pset_file_space_page_size(space, 4096), "choose the file's pages");
  return {H5Fcreate(path.c_str(), H5F_ACC_TRUNC, space, access), "create the file"};
}

protocol::StepClock clock_of(const Welcome& welcome) {
  try {
    return {welcome.interval_ns(), welcome.steps_per_interval(), welcome.steps()};
  } catch (const std::invalid_argument& error) {
    throw ProtocolError(fmt::format("the Welcome's clock is not usable: {}", error.what()));
  }
}

}  // namespace

class Writer::File {
 public:
  File(OutputFile output, const Message& message, h5::Storage storage)
      : File(std::move(output), message.header.welcome()) {
    write_prologue(file_, message);
    frames_ = FrameTable::create(file_, message.header.welcome(), storage);
    exchanges_ = ExchangeTable::create(file_, bodies_, storage);
    if (storage == h5::Storage::kPlain)
      h5::check(H5Fstart_swmr_write(file_), "start single-writer multiple-reader mode");
    flush();
    output_.keep();
  }

  void write_frame(const Message& message) {
    if (bodies_ > 0 && message.header.step() > exchanges())
      throw ProtocolError(fmt::format("frame {} of step {} came before the exchanges of the steps from {}",
                                      message.header.frame().index(), message.header.step(),
                                      exchanges() + 1));
    frames_->append(message);
  }
  void write_exchange(const Message& message) { exchanges_->append(message, clock_); }
  void flush() { h5::check(H5Fflush(file_, H5F_SCOPE_GLOBAL), "flush the file"); }

  // Under SWMR nothing may be added, but attributes of the same size may be written again. The tables close
  // before the file, which stays open while one of its datasets is.
  void finish(const std::string& reason, const std::string& detail, double wall_seconds) {
    flush();
    h5::rewrite_attribute(file_, "/status", "wall_seconds", fmt::format("{:.3f}", wall_seconds));
    h5::rewrite_attribute(file_, "/status", "detail", detail);
    h5::rewrite_attribute(file_, "/status", "reason", reason);
    flush();
    frames_.reset();
    exchanges_.reset();
    file_.reset("close the file");
  }

  [[nodiscard]] std::uint64_t frames() const { return frames_->length(); }
  [[nodiscard]] std::uint64_t exchanges() const { return exchanges_->length(); }

 private:
  File(OutputFile output, const Welcome& welcome)
      : output_(std::move(output)),
        clock_(clock_of(welcome)),
        bodies_(static_cast<hsize_t>(welcome.scene().body_size())),
        file_(create_file(output_.path())) {}

  OutputFile output_;
  protocol::StepClock clock_;
  hsize_t bodies_;
  h5::File file_;
  std::optional<FrameTable> frames_;
  std::optional<ExchangeTable> exchanges_;
};

Writer::Writer(OutputFile file, const Message& welcome, h5::Storage storage) {
  h5::silence();
  if (!welcome.header.has_welcome()) throw ProtocolError("a recording starts with a Welcome");
  const std::string name = file.path().string();
  try {
    file_ = std::make_unique<File>(std::move(file), welcome, storage);
  } catch (const h5::Error& error) {
    throw InputError(fmt::format("{}: {}", name, error.what()));
  }
}

Writer::~Writer() = default;
Writer::Writer(Writer&&) noexcept = default;

// Closing a file after a failed write would mark it as whole; leaving it open keeps it readable up to the
// last flush. The process is about to end.
template <typename Action>
void Writer::guarded(Action action) {
  if (!file_) throw std::logic_error("the recording has failed before");
  try {
    action();
  } catch (const h5::Error&) {
    static auto& abandoned = *new std::vector<std::unique_ptr<File>>;
    abandoned.push_back(std::move(file_));
    throw;
  }
}

void Writer::write(const Message& message) {
  guarded([&] {
    switch (message.header.content_case()) {
      case Header::kFrame:
        return file_->write_frame(message);
      case Header::kExchangeLog:
        return file_->write_exchange(message);
      default:
        throw ProtocolError("only frames and exchanges are recorded");
    }
  });
}

void Writer::flush() {
  guarded([&] { file_->flush(); });
}

void Writer::finish(const std::string& reason, const std::string& detail, double wall_seconds) {
  guarded([&] { file_->finish(reason, detail, wall_seconds); });
}

}  // namespace sluice::clients
