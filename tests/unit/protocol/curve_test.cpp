#include "protocol/curve.hpp"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include "protocol/endpoint.hpp"
#include "protocol/error.hpp"
#include "temporary_directory.hpp"

namespace sluice::protocol {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr int kPatience = 10'000;  // [ms], only to end a test that fails

unsigned mode(const std::filesystem::path& path) {
  struct stat status {};
  return stat(path.c_str(), &status) == 0 ? status.st_mode & 0777 : 0;
}

void allow(const std::filesystem::path& file) {
  std::filesystem::permissions(file,
                               std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
}

// A server that lets one key in.
class Curve : public testing::Test {
 protected:
  const KeyPair server_ = make_key_pair();
  const KeyPair client_ = make_key_pair();
  zmq::context_t context_;
  const Authenticator authenticator_{context_, {server_, {client_.public_key}}};
  zmq::socket_t listener_ = listen();
  const std::string address_ = listener_.get(zmq::sockopt::last_endpoint);
  zmq::context_t elsewhere_;

  zmq::socket_t listen() {
    auto socket = make_socket(context_, zmq::socket_type::pull);
    authenticator_.secure(socket);
    socket.bind("tcp://127.0.0.1:*");
    return socket;
  }

  // How the connection's first handshake ended.
  int connect_and_watch(zmq::socket_t& socket) {
    socket.set(zmq::sockopt::reconnect_ivl, -1);
    constexpr int ends = ZMQ_EVENT_HANDSHAKE_SUCCEEDED | ZMQ_EVENT_HANDSHAKE_FAILED_NO_DETAIL |
                         ZMQ_EVENT_HANDSHAKE_FAILED_PROTOCOL | ZMQ_EVENT_HANDSHAKE_FAILED_AUTH;
    EXPECT_EQ(zmq_socket_monitor(socket.handle(), "inproc://monitor", ends), 0);
    zmq::socket_t monitor(elsewhere_, zmq::socket_type::pair);
    monitor.set(zmq::sockopt::rcvtimeo, kPatience);
    monitor.connect("inproc://monitor");
    socket.connect(address_);
    zmq::message_t event, peer;
    std::uint16_t id = 0;
    if (monitor.recv(event) && monitor.recv(peer)) std::memcpy(&id, event.data(), sizeof id);
    zmq_socket_monitor(socket.handle(), nullptr, 0);
    return id;
  }
};

TEST_F(Curve, AllowedKeyPasses) {
  auto socket = make_socket(elsewhere_, zmq::socket_type::push);
  ClientKeys{client_, server_.public_key}.secure(socket);
  EXPECT_EQ(connect_and_watch(socket), ZMQ_EVENT_HANDSHAKE_SUCCEEDED);
  socket.send(zmq::str_buffer("hello"));
  listener_.set(zmq::sockopt::rcvtimeo, kPatience);
  zmq::message_t message;
  ASSERT_TRUE(listener_.recv(message));
  EXPECT_EQ(message.to_string_view(), "hello");
}

TEST_F(Curve, UnknownKeyDoesNot) {
  auto socket = make_socket(elsewhere_, zmq::socket_type::push);
  ClientKeys{make_key_pair(), server_.public_key}.secure(socket);
  EXPECT_EQ(connect_and_watch(socket), ZMQ_EVENT_HANDSHAKE_FAILED_AUTH);
}

TEST_F(Curve, NoKeyDoesNot) {
  auto socket = make_socket(elsewhere_, zmq::socket_type::push);
  EXPECT_NE(connect_and_watch(socket), ZMQ_EVENT_HANDSHAKE_SUCCEEDED);
}

TEST_F(Curve, WrongServerKeyDoesNot) {
  auto socket = make_socket(elsewhere_, zmq::socket_type::push);
  ClientKeys{client_, make_key_pair().public_key}.secure(socket);
  EXPECT_NE(connect_and_watch(socket), ZMQ_EVENT_HANDSHAKE_SUCCEEDED);
}

TEST(KeyFiles, ServeBothSides) {
  const TemporaryDirectory directory;
  make_key_files(directory / "keys");
  const auto server = ServerKeys::load(directory / "keys");
  const auto client = ClientKeys::load(directory / "keys");
  EXPECT_EQ(client.server, server.pair.public_key);
  EXPECT_EQ(server.allowed, std::set{client.pair.public_key});
  EXPECT_NE(client.pair.secret_key, server.pair.secret_key);
}

TEST(KeyFiles, SecretsAreTheOwnersAlone) {
  const TemporaryDirectory directory;
  make_key_files(directory / "keys");
  EXPECT_EQ(mode(directory / "keys"), 0700U);
  EXPECT_EQ(mode(directory / "keys/server.secret"), 0600U);
  EXPECT_EQ(mode(directory / "keys/client.secret"), 0600U);
}

TEST(KeyFiles, AreNeverOverwritten) {
  const TemporaryDirectory directory;
  make_key_files(directory / "keys");
  const auto before = ServerKeys::load(directory / "keys");
  EXPECT_THAT([&] { make_key_files(directory / "keys"); }, ThrowsMessage<InputError>(HasSubstr("exists")));
  EXPECT_EQ(ServerKeys::load(directory / "keys").pair.secret_key, before.pair.secret_key);
}

TEST(KeyFiles, SecretThatOthersMayReadIsRefused) {
  const TemporaryDirectory directory;
  make_key_files(directory / "keys");
  std::filesystem::permissions(directory / "keys/server.secret", std::filesystem::perms::group_read,
                               std::filesystem::perm_options::add);
  EXPECT_THAT([&] { ServerKeys::load(directory / "keys"); },
              ThrowsMessage<InputError>(HasSubstr("may be read by others")));
}

TEST(KeyFiles, NamesWhatIsAbsentOrMalformed) {
  const TemporaryDirectory directory;
  EXPECT_THAT([&] { ClientKeys::load(directory.path()); },
              ThrowsMessage<InputError>(
                  HasSubstr("client.secret: No such file or directory; make keys with: sluice keygen")));
  allow(directory.write("client.secret", "public short\nsecret short\n"));
  EXPECT_THAT([&] { ClientKeys::load(directory.path()); },
              ThrowsMessage<InputError>(HasSubstr("no line \"public KEY\"")));
}

TEST(KeyFiles, EmptyAllowListIsRefused) {
  const TemporaryDirectory directory;
  make_key_files(directory / "keys");
  std::filesystem::remove(directory / "keys/allowed/client.public");
  EXPECT_THAT([&] { ServerKeys::load(directory / "keys"); },
              ThrowsMessage<InputError>(HasSubstr("nobody could connect")));
}

}  // namespace
}  // namespace sluice::protocol
