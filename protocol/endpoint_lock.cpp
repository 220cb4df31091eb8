#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include <fmt/format.h>

#include "protocol/endpoint.hpp"
#include "protocol/error.hpp"

namespace sluice::protocol {
namespace {

constexpr std::string_view kIpc = "ipc://";

std::filesystem::path lock_path(const std::filesystem::path& socket) {
  return socket.string() + ".lock";
}

// Whether the open file is still the one at the path; its last holder may just have removed it.
bool is_current(int descriptor, const std::filesystem::path& path) {
  struct stat opened {};
  struct stat named {};
  return fstat(descriptor, &opened) == 0 && stat(path.c_str(), &named) == 0 &&
         opened.st_ino == named.st_ino && opened.st_dev == named.st_dev;
}

int open_locked(const std::filesystem::path& path, const std::string& endpoint) {
  while (true) {
    const int descriptor = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, S_IRUSR | S_IWUSR);
    if (descriptor < 0)
      throw InputError(
          fmt::format("endpoint {}: cannot create {}: {}; choose a directory that exists and that "
                      "you may write to",
                      endpoint, path.string(), std::strerror(errno)));
    if (flock(descriptor, LOCK_EX | LOCK_NB) != 0) {
      close(descriptor);
      throw InputError(fmt::format(
          "endpoint {} is in use by another server; stop it or choose another endpoint", endpoint));
    }
    if (is_current(descriptor, path)) return descriptor;
    close(descriptor);
  }
}

}  // namespace

EndpointLock::EndpointLock(const Endpoint& endpoint) {
  if (!endpoint.exchange.starts_with(kIpc)) return;
  socket_ = endpoint.exchange.substr(kIpc.size());
  descriptor_ = open_locked(lock_path(socket_), endpoint.exchange);
}

EndpointLock::~EndpointLock() {
  if (descriptor_ < 0) return;
  std::error_code ignored;
  for (const char* suffix : {"", ".publish", ".record", ".lock"})
    std::filesystem::remove(socket_.string() + suffix, ignored);
  close(descriptor_);
}

}  // namespace sluice::protocol
