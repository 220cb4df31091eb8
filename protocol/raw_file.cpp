#include "protocol/raw_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "protocol/error.hpp"

namespace sluice::protocol {

RawFile::RawFile(const std::filesystem::path& path, Use use)
    : path_(path),
      descriptor_(open(path.c_str(),
                       (use == kRead ? O_RDONLY | O_NONBLOCK : O_WRONLY | O_CREAT | O_TRUNC) | O_CLOEXEC,
                       0666)) {
  if (descriptor_ < 0) fail("open");
}

RawFile::~RawFile() {
  close(descriptor_);
}

void RawFile::write(const void* data, std::size_t count) {
  const auto* from = static_cast<const char*>(data);
  while (count > 0) {
    const ssize_t done = ::write(descriptor_, from, count);
    if (done < 0 && errno == EINTR) continue;
    if (done < 0) fail("write");
    from += done;
    count -= static_cast<std::size_t>(done);
  }
}

bool RawFile::read(void* data, std::size_t count) {
  auto* to = static_cast<char*>(data);
  while (count > 0) {
    const ssize_t done = ::read(descriptor_, to, count);
    if (done < 0 && errno == EINTR) continue;
    if (done < 0) fail("read");
    if (done == 0) return false;
    to += done;
    count -= static_cast<std::size_t>(done);
  }
  return true;
}

void RawFile::rewind() {
  if (lseek(descriptor_, 0, SEEK_SET) != 0) fail("read");
}

std::uint64_t RawFile::size() const {
  struct stat status {};
  if (fstat(descriptor_, &status) != 0) fail("read");
  if (!S_ISREG(status.st_mode)) throw InputError(path_.string() + " is not a regular file");
  return static_cast<std::uint64_t>(status.st_size);
}

void RawFile::synchronise() {
  if (fsync(descriptor_) != 0) fail("synchronise");
}

void RawFile::fail(const char* what) const {
  throw std::system_error(errno, std::generic_category(), fmt::format("cannot {} {}", what, path_.string()));
}

}  // namespace sluice::protocol
