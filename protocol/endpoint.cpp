#include "protocol/endpoint.hpp"

#include <arpa/inet.h>
#include <sys/stat.h>
#include <sys/un.h>

#include <cerrno>
#include <charconv>
#include <cstdlib>
#include <cstring>

#include <fmt/format.h>

#include "protocol/error.hpp"

namespace sluice::protocol {
namespace {

constexpr std::string_view kIpc = "ipc://";
constexpr std::string_view kTcp = "tcp://";
constexpr std::string_view kPublish = ".publish";
constexpr std::string_view kRecord = ".record";
constexpr int kLastPort = 65535 - 2;  // two more follow the exchange's

bool is_loopback(const std::string& host) {
  in_addr address{};
  if (inet_pton(AF_INET, host.c_str(), &address) != 1) return host == "localhost";
  return ntohl(address.s_addr) >> 24 == 127;
}

Endpoint parse_ipc(const std::string& text) {
  const std::string path = text.substr(kIpc.size());
  constexpr std::size_t longest = sizeof(sockaddr_un::sun_path) - 1 - kPublish.size();
  if (path.empty() || path.front() == '@' || path.find('*') != std::string::npos)
    throw InputError(fmt::format("endpoint {}: needs the path of a socket file after ipc://", text));
  if (path.size() > longest)
    throw InputError(
        fmt::format("endpoint {}: the path has {} characters, a socket's may have {}; choose a shorter one",
                    text, path.size(), longest));
  return {text, text + std::string(kPublish), text + std::string(kRecord)};
}

Endpoint parse_tcp(const std::string& text, bool allow_remote) {
  const std::string address = text.substr(kTcp.size());
  const std::size_t colon = address.rfind(':');
  const std::string host = address.substr(0, colon);
  const std::string digits = colon == std::string::npos ? "" : address.substr(colon + 1);
  int port = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), port);
  if (host.empty() || host.find(':') != std::string::npos || error != std::errc{} ||
      end != digits.data() + digits.size() || port < 1 || port > kLastPort)
    throw InputError(fmt::format(
        "endpoint {}: needs tcp://HOST:PORT with a host name or IPv4 address and a port of 1 to {}", text,
        kLastPort));
  if (!allow_remote && !is_loopback(host))
    throw InputError(
        fmt::format("endpoint {}: {} is not this machine; other machines need keys (sluice keygen DIR, then "
                    "--keys DIR on both sides), without keys use tcp://127.0.0.1:{}",
                    text, host, port));
  const auto at = [&](int offset) { return fmt::format("tcp://{}:{}", host, port + offset); };
  return {at(0), at(1), at(2)};
}

std::string advice(int error) {
  switch (error) {
    case EADDRINUSE:
      return "; another program uses it, choose another endpoint or stop that program";
    case ENOENT:
      return "; the directory does not exist, create it";
    case EACCES:
      return "; choose a directory or port that you may use";
    case EADDRNOTAVAIL:
    case ENODEV:
      return "; no network interface of this machine has that address";
    default:
      return "";
  }
}

}  // namespace

Endpoint Endpoint::parse(const std::string& text, bool allow_remote) {
  if (text.find_first_of(" \t\r\n") != std::string::npos || text.find('\0') != std::string::npos)
    throw InputError(fmt::format("endpoint \"{}\": contains white space", text));
  if (text.starts_with(kIpc)) return parse_ipc(text);
  if (text.starts_with(kTcp)) return parse_tcp(text, allow_remote);
  throw InputError(fmt::format("endpoint \"{}\": needs ipc://PATH or tcp://HOST:PORT", text));
}

std::string private_endpoint() {
  const char* runtime = std::getenv("XDG_RUNTIME_DIR");
  std::error_code ignored;
  const bool usable = runtime != nullptr && std::filesystem::is_directory(runtime, ignored);
  const std::filesystem::path base = usable ? runtime : std::filesystem::temp_directory_path();
  std::string directory = base / "sluice-XXXXXX";
  if (mkdtemp(directory.data()) == nullptr)
    throw InputError(
        fmt::format("cannot create a directory for sockets in {}: {}; set XDG_RUNTIME_DIR or TMPDIR",
                    base.string(), std::strerror(errno)));
  return Endpoint::parse(fmt::format("ipc://{}/server", directory)).exchange;
}

zmq::socket_t make_socket(zmq::context_t& context, zmq::socket_type type) {
  zmq::socket_t socket(context, type);
  socket.set(zmq::sockopt::linger, 1000);
  socket.set(zmq::sockopt::maxmsgsize, std::int64_t{1} << 30);
  // A ping each second, and two seconds for an answer: a stopped peer is noticed within three.
  socket.set(zmq::sockopt::heartbeat_ivl, 1000);
  socket.set(zmq::sockopt::heartbeat_timeout, 2000);
  socket.set(zmq::sockopt::heartbeat_ttl, 3000);
  if (type == zmq::socket_type::router) socket.set(zmq::sockopt::router_mandatory, true);
  // A watcher that does not keep up loses messages; it never costs the server more than these.
  if (type == zmq::socket_type::xpub) socket.set(zmq::sockopt::sndhwm, 8);
  return socket;
}

void bind(zmq::socket_t& socket, const std::string& endpoint) {
  try {
    socket.bind(endpoint);
  } catch (const zmq::error_t& error) {
    throw InputError(
        fmt::format("cannot listen on {}: {}{}", endpoint, zmq_strerror(error.num()), advice(error.num())));
  }
  if (endpoint.starts_with(kIpc)) chmod(endpoint.substr(kIpc.size()).c_str(), S_IRUSR | S_IWUSR);
}

}  // namespace sluice::protocol
