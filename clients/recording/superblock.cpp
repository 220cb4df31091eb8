#include "clients/recording/superblock.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <string_view>

#include "protocol/error.hpp"

namespace sluice::clients {
namespace {

using protocol::InputError;

constexpr std::string_view kSignature("\x89HDF\r\n\x1a\n", 8);
constexpr std::size_t kVersion = 8;
constexpr std::size_t kFlags = 11;
constexpr std::size_t kEndOfFile = 28;  // an address of 8 bytes
constexpr int kOpenedForWriting = 1;
constexpr int kOpenedForSwmr = 4;

struct Start {
  std::array<char, 48> bytes{};
  std::uint64_t file_size = 0;
};

Start read_start(const std::filesystem::path& path) {
  const int descriptor = open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (descriptor < 0)
    throw InputError(fmt::format("cannot read {}: {}", path.string(), std::strerror(errno)));
  struct stat status {};
  fstat(descriptor, &status);
  Start start;
  start.file_size = static_cast<std::uint64_t>(status.st_size);
  const ssize_t count =
      S_ISREG(status.st_mode) ? read(descriptor, start.bytes.data(), start.bytes.size()) : -1;
  close(descriptor);
  if (count < 0) throw InputError(path.string() + " is not a regular file");
  if (count == 0) throw InputError(path.string() + " is empty");
  return start;
}

}  // namespace

Superblock read_superblock(const std::filesystem::path& path) {
  const Start start = read_start(path);
  if (std::memcmp(start.bytes.data(), kSignature.data(), kSignature.size()) != 0)
    throw InputError(path.string() + " is not an HDF5 file, so no recording");
  if (start.bytes[kVersion] < 3)
    throw InputError(path.string() + " is an HDF5 file, but not a recording of sluice");
  std::uint64_t end_of_file = 0;
  std::memcpy(&end_of_file, &start.bytes[kEndOfFile], sizeof end_of_file);
  const int flags = start.bytes[kFlags];
  return {(flags & kOpenedForWriting) != 0, (flags & kOpenedForSwmr) != 0, start.file_size < end_of_file};
}

}  // namespace sluice::clients
