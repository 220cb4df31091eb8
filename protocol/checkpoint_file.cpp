#include "protocol/checkpoint_file.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <memory>
#include <string_view>
#include <system_error>

#include "protocol/error.hpp"
#include "protocol/raw_file.hpp"

namespace sluice::protocol {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kSignature("SLUICECP", 8);
constexpr std::uint32_t kFormat = 1;  // raised by a change that older programs would misread

// What stands between the signature and the header.
struct Preamble {
  std::uint32_t format, header_bytes;
};

class Checksum {
 public:
  void add(const void* data, std::size_t count) { XXH3_64bits_update(state_.get(), data, count); }
  [[nodiscard]] std::uint64_t value() const { return XXH3_64bits_digest(state_.get()); }

 private:
  static XXH3_state_t* create() {
    XXH3_state_t* state = XXH3_createState();
    XXH3_64bits_reset(state);
    return state;
  }
  std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state_{create(), &XXH3_freeState};
};

// Nothing but signature and format is believed before the checksum of all has been seen to fit.
class Reading {
 public:
  explicit Reading(const fs::path& path) : path_(path), file_(path, RawFile::kRead), left_(file_.size()) {}

  CheckpointFile all() {
    const std::uint64_t size = left_;
    const Preamble preamble = read_start();
    check_sum();
    file_.rewind();
    left_ = size - sizeof(std::uint64_t);  // the checksum
    (void)read_start();
    CheckpointFile file;
    std::string header;
    take(header, preamble.header_bytes);
    if (!file.header.ParseFromString(header)) damaged("its header is no message");
    take(file.fluid, file.header.fluid_bytes());
    take(file.rigid, file.header.rigid_numbers());
    if (left_ > 0) damaged(fmt::format("{} bytes too many", left_));
    return file;
  }

 private:
  Preamble read_start() {
    std::string signature(kSignature.size(), '\0');
    Preamble preamble{};
    if (left_ < signature.size() + sizeof preamble) not_one();
    take(signature.data(), signature.size());
    if (signature != kSignature) not_one();
    take(&preamble, sizeof preamble);
    if (preamble.format == kFormat) return preamble;
    throw InputError(fmt::format(
        "{} is a checkpoint of format {}, this program reads format {}; use the sluice that wrote it",
        path_.string(), preamble.format, kFormat));
  }

  // From after the start to the end.
  void check_sum() {
    std::vector<char> piece(std::size_t{1} << 20);
    while (left_ > sizeof(std::uint64_t))
      take(piece.data(), std::min<std::uint64_t>(piece.size(), left_ - sizeof(std::uint64_t)));
    const std::uint64_t expected = sum_.value();
    std::uint64_t recorded = 0;
    take(&recorded, sizeof recorded);
    if (recorded != expected) damaged("its checksum does not fit what is in it");
  }

  template <typename Container>
  void take(Container& values, std::uint64_t count) {
    if (count > left_ / sizeof(typename Container::value_type)) damaged("its end is missing");
    values.resize(count);
    take(values.data(), count * sizeof(typename Container::value_type));
  }
  void take(void* data, std::size_t count) {
    if (count > left_ || !file_.read(data, count)) damaged("its end is missing");
    left_ -= count;
    sum_.add(data, count);
  }

  [[noreturn]] void not_one() const { throw InputError(path_.string() + " is not a checkpoint of sluice"); }
  [[noreturn]] void damaged(const std::string& how) const {
    throw InputError(fmt::format("{} is damaged: {}", path_.string(), how));
  }

  fs::path path_;
  RawFile file_;
  std::uint64_t left_;
  Checksum sum_;
};

CheckpointFile read_alone(const fs::path& path) {
  try {
    return Reading(path).all();
  } catch (const std::system_error& error) {
    throw InputError(error.what());
  }
}

// Whether a checkpoint of that run stands there, whole.
bool holds(const fs::path& path, const std::string& run_id) {
  try {
    return fs::exists(path) && read_alone(path).header.run_id() == run_id;
  } catch (const InputError&) {
    return false;
  }
}

void write_alone(const fs::path& path, CheckpointFile& file) {
  file.header.set_fluid_bytes(file.fluid.size());
  file.header.set_rigid_numbers(file.rigid.size());
  const std::string header = file.header.SerializeAsString();
  const Preamble preamble{kFormat, static_cast<std::uint32_t>(header.size())};
  RawFile output(path, RawFile::kCreate);
  Checksum sum;
  const auto put = [&](const void* data, std::size_t count) {
    sum.add(data, count);
    output.write(data, count);
  };
  put(kSignature.data(), kSignature.size());
  put(&preamble, sizeof preamble);
  put(header.data(), header.size());
  put(file.fluid.data(), file.fluid.size());
  put(file.rigid.data(), file.rigid.size() * sizeof(double));
  const std::uint64_t value = sum.value();
  output.write(&value, sizeof value);
  output.synchronise();
}

// A rename is on disk when its directory is.
void synchronise_directory(const fs::path& file) {
  const fs::path parent = file.parent_path();
  RawFile(parent.empty() ? "." : parent, RawFile::kRead).synchronise();
}

}  // namespace

fs::path previous_checkpoint(const fs::path& path) {
  return fs::path(path).replace_extension(".previous" + path.extension().string());
}

CheckpointFile read_checkpoint(const fs::path& path) {
  try {
    return read_alone(path);
  } catch (const InputError& error) {
    const fs::path previous = previous_checkpoint(path);
    if (!fs::exists(previous)) throw;
    throw InputError(fmt::format("{}; the checkpoint before it is {}", error.what(), previous.string()));
  }
}

// By a second name the present file becomes the previous one while it still has its own, where the file
// system knows such names.
void write_checkpoint(const fs::path& path, CheckpointFile& file) {
  const fs::path aside = path.string() + ".new", previous = previous_checkpoint(path);
  write_alone(aside, file);
  if (holds(path, file.header.run_id())) {
    fs::remove(previous);
    std::error_code unsupported;
    fs::create_hard_link(path, previous, unsupported);
    if (unsupported) fs::rename(path, previous);
  } else if (!holds(previous, file.header.run_id())) {
    fs::remove(previous);
  }
  fs::rename(aside, path);
  synchronise_directory(path);
}

}  // namespace sluice::protocol
