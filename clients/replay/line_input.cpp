#include "clients/replay/line_input.hpp"

#include <unistd.h>

#include <array>
#include <cerrno>

namespace sluice::clients {

std::vector<std::string> LineInput::read() {
  std::array<char, 512> piece{};
  const ssize_t count = ::read(descriptor_, piece.data(), piece.size());
  if (count < 0 && (errno == EINTR || errno == EAGAIN)) return {};
  if (count <= 0) {
    descriptor_ = -1;
    return {};
  }
  begun_.append(piece.data(), static_cast<std::size_t>(count));
  std::vector<std::string> lines;
  for (std::size_t end = begun_.find('\n'); end != std::string::npos; end = begun_.find('\n')) {
    lines.push_back(begun_.substr(0, end));
    begun_.erase(0, end + 1);
  }
  return lines;
}

}  // namespace sluice::clients
