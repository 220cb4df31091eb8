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
constexpr unsigned kOpenedForWriting = 1;
constexpr unsigned kOpenedForSwmr = 4;

std::array<unsigned char, 12> first_bytes(const std::filesystem::path& path) {
  const int descriptor = open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (descriptor < 0)
    throw InputError(fmt::format("cannot read {}: {}", path.string(), std::strerror(errno)));
  struct stat status {};
  fstat(descriptor, &status);
  std::array<unsigned char, 12> bytes{};
  const ssize_t count = S_ISREG(status.st_mode) ? read(descriptor, bytes.data(), bytes.size()) : -1;
  close(descriptor);
  if (count < 0) throw InputError(path.string() + " is not a regular file");
  if (count == 0) throw InputError(path.string() + " is empty");
  return bytes;
}

}  // namespace

FileState file_state(const std::filesystem::path& path) {
  const auto bytes = first_bytes(path);
  if (std::memcmp(bytes.data(), kSignature.data(), kSignature.size()) != 0)
    throw InputError(path.string() + " is not an HDF5 file, so no recording");
  if (bytes[kVersion] < 3)
    throw InputError(path.string() + " is an HDF5 file, but not a recording of sluice");
  if ((bytes[kFlags] & kOpenedForSwmr) != 0) return FileState::kOpenForSwmr;
  return (bytes[kFlags] & kOpenedForWriting) != 0 ? FileState::kOpenForWriter : FileState::kClosed;
}

}  // namespace sluice::clients
