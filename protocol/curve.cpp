#include "protocol/curve.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <map>

#include "protocol/error.hpp"

namespace sluice::protocol {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kKeyLength = 40;  // Z85 of 32 bytes
constexpr const char* kServerSecret = "server.secret";
constexpr const char* kServerPublic = "server.public";
constexpr const char* kClientSecret = "client.secret";
constexpr const char* kAllowed = "allowed";

std::string public_line(const KeyPair& pair) {
  return fmt::format("public {}\n", pair.public_key);
}
std::string pair_lines(const KeyPair& pair) {
  return public_line(pair) + fmt::format("secret {}\n", pair.secret_key);
}

void make_directory(const fs::path& directory) {
  if (mkdir(directory.c_str(), S_IRWXU) != 0 && errno != EEXIST)
    throw InputError(fmt::format("cannot create {}: {}", directory.string(), std::strerror(errno)));
}

void write_new(const fs::path& path, const std::string& text) {
  const int descriptor = open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, S_IRUSR | S_IWUSR);
  const bool written =
      descriptor >= 0 && write(descriptor, text.data(), text.size()) == static_cast<ssize_t>(text.size());
  const int reason = errno;
  if (descriptor >= 0) close(descriptor);
  if (!written) throw InputError(fmt::format("cannot write {}: {}", path.string(), std::strerror(reason)));
}

void check_private(const fs::path& path) {
  const auto others = fs::perms::group_all | fs::perms::others_all;
  if ((fs::status(path).permissions() & others) != fs::perms::none)
    throw InputError(fmt::format("{} may be read by others; chmod 600 it, or make new keys if it was exposed",
                                 path.string()));
}

// The keys of a file by their kind, "public" or "secret".
std::map<std::string, std::string> read_keys(const fs::path& path) {
  std::ifstream file(path);
  if (!file)
    throw InputError(fmt::format("cannot read {}: {}; make keys with: sluice keygen {}", path.string(),
                                 std::strerror(errno), path.parent_path().string()));
  std::map<std::string, std::string> keys;
  std::string kind, key;
  while (keys.size() < 3 && file >> kind >> key) keys[kind] = key;
  return keys;
}

std::string take(const std::map<std::string, std::string>& keys, const char* kind, const fs::path& path) {
  std::array<std::uint8_t, 32> bytes{};
  const auto found = keys.find(kind);
  if (found == keys.end() || found->second.size() != kKeyLength ||
      zmq_z85_decode(bytes.data(), found->second.c_str()) == nullptr)
    throw InputError(fmt::format("{} has no line \"{} KEY\" with a key of {} characters in Z85",
                                 path.string(), kind, kKeyLength));
  return found->second;
}

std::string read_public(const fs::path& path) {
  return take(read_keys(path), "public", path);
}

KeyPair read_pair(const fs::path& path) {
  const auto keys = read_keys(path);
  check_private(path);
  return {take(keys, "public", path), take(keys, "secret", path)};
}

std::set<std::string> read_allowed(const fs::path& directory) {
  std::set<std::string> allowed;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(directory, error)) {
    if (entry.path().extension() == ".public") allowed.insert(read_public(entry.path()));
  }
  if (allowed.empty())
    throw InputError(
        fmt::format("{} holds no *.public key, so that nobody could connect; copy the clients' there",
                    directory.string()));
  return allowed;
}

}  // namespace

KeyPair make_key_pair() {
  std::array<char, kKeyLength + 1> public_key{}, secret_key{};
  if (zmq_curve_keypair(public_key.data(), secret_key.data()) != 0)
    throw InputError("this build of ZeroMQ has no CURVE; install one with libsodium");
  return {public_key.data(), secret_key.data()};
}

void make_key_files(const fs::path& directory) {
  const KeyPair server = make_key_pair();
  const KeyPair client = make_key_pair();
  const std::map<fs::path, std::string> files{{directory / kServerSecret, pair_lines(server)},
                                              {directory / kServerPublic, public_line(server)},
                                              {directory / kClientSecret, pair_lines(client)},
                                              {directory / kAllowed / "client.public", public_line(client)}};
  for (const auto& [path, text] : files) {
    if (fs::exists(path))
      throw InputError(fmt::format("{} exists; remove it first or choose another directory", path.string()));
  }
  make_directory(directory);
  make_directory(directory / kAllowed);
  for (const auto& [path, text] : files) write_new(path, text);
}

ServerKeys ServerKeys::load(const fs::path& directory) {
  return {read_pair(directory / kServerSecret), read_allowed(directory / kAllowed)};
}

ClientKeys ClientKeys::load(const fs::path& directory) {
  return {read_pair(directory / kClientSecret), read_public(directory / kServerPublic)};
}

void ClientKeys::secure(zmq::socket_t& socket) const {
  socket.set(zmq::sockopt::curve_serverkey, server);
  socket.set(zmq::sockopt::curve_publickey, pair.public_key);
  socket.set(zmq::sockopt::curve_secretkey, pair.secret_key);
}

}  // namespace sluice::protocol
