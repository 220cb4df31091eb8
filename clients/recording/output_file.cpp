#include "clients/recording/output_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "protocol/error.hpp"

namespace sluice::clients {
namespace {

using protocol::InputError;

[[noreturn]] void fail(const std::filesystem::path& path) {
  throw InputError(
      fmt::format("cannot write {}: {}; choose a file in a directory that exists and is writable",
                  path.string(), std::strerror(errno)));
}

void require_regular(int descriptor, const std::filesystem::path& path) {
  struct stat status {};
  if (fstat(descriptor, &status) != 0) fail(path);
  if (!S_ISREG(status.st_mode))
    throw InputError(path.string() + " is not a regular file; choose another name");
}

// A lock of the open file description: it goes with the process, however that ends, and is independent of the
// locks that HDF5 takes.
struct flock whole_file(short type) {
  struct flock lock {};
  lock.l_type = type;
  lock.l_whence = SEEK_SET;
  return lock;
}

}  // namespace

OutputFile::OutputFile(std::filesystem::path path, bool force) : path_(std::move(path)) {
  descriptor_ = open(path_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  created_ = descriptor_ >= 0;
  if (!created_) {
    if (errno != EEXIST) fail(path_);
    if (!force) {
      throw InputError(path_.string() + " exists already; choose another name, or replace it with --force");
    }
    descriptor_ = open(path_.c_str(), O_RDWR | O_CLOEXEC | O_NONBLOCK);
    if (descriptor_ < 0) fail(path_);
  }
  try {
    require_regular(descriptor_, path_);
    struct flock lock = whole_file(F_WRLCK);
    if (fcntl(descriptor_, F_OFD_SETLK, &lock) != 0 && (errno == EAGAIN || errno == EACCES)) {
      throw InputError(path_.string() +
                       " is being written by another process; stop it or choose another name");
    }
  } catch (...) {
    close(descriptor_);
    throw;
  }
}

OutputFile::OutputFile(OutputFile&& other) noexcept
    : path_(std::move(other.path_)),
      descriptor_(std::exchange(other.descriptor_, -1)),
      created_(std::exchange(other.created_, false)) {}

OutputFile::~OutputFile() {
  if (created_) unlink(path_.c_str());
  if (descriptor_ >= 0) close(descriptor_);
}

bool is_being_written(const std::filesystem::path& path) {
  const int descriptor = open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (descriptor < 0) return false;
  struct flock lock = whole_file(F_RDLCK);
  const bool held = fcntl(descriptor, F_OFD_GETLK, &lock) == 0 && lock.l_type != F_UNLCK;
  close(descriptor);
  return held;
}

}  // namespace sluice::clients
