#include "protocol/endpoint.hpp"

#include <gmock/gmock.h>
#include <sys/stat.h>
#include <unistd.h>

#include "protocol/error.hpp"
#include "temporary_directory.hpp"

namespace sluice::protocol {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(Endpoint, DerivesTheOthersFromAPath) {
  const auto endpoint = Endpoint::parse("ipc:///run/sluice/server");
  EXPECT_EQ(endpoint.exchange, "ipc:///run/sluice/server");
  EXPECT_EQ(endpoint.publish, "ipc:///run/sluice/server.publish");
  EXPECT_EQ(endpoint.record, "ipc:///run/sluice/server.record");
}

TEST(Endpoint, DerivesTheOthersFromAPort) {
  const auto endpoint = Endpoint::parse("tcp://127.0.0.1:5555");
  EXPECT_EQ(endpoint.exchange, "tcp://127.0.0.1:5555");
  EXPECT_EQ(endpoint.publish, "tcp://127.0.0.1:5556");
  EXPECT_EQ(endpoint.record, "tcp://127.0.0.1:5557");
}

TEST(Endpoint, KeepsToThisMachineWithoutKeys) {
  for (const char* here : {"tcp://localhost:5555", "tcp://127.8.9.1:5555"})
    EXPECT_NO_THROW(Endpoint::parse(here));
  for (const char* elsewhere :
       {"tcp://10.0.0.7:5555", "tcp://*:5555", "tcp://0.0.0.0:5555", "tcp://tank:5555",
        "tcp://127.evil.example:5555", "tcp://localhost.example:5555"}) {
    EXPECT_THAT([&] { Endpoint::parse(elsewhere); },
                ThrowsMessage<InputError>(AllOf(HasSubstr(elsewhere), HasSubstr("keygen"))));
    EXPECT_NO_THROW(Endpoint::parse(elsewhere, true));
  }
}

TEST(Endpoint, RefusesWhatIsNoAddress) {
  for (const char* bad :
       {"", "127.0.0.1:5555", "udp://127.0.0.1:5555", "inproc://a", "ipc://", "ipc://*", "ipc://@name",
        "tcp://127.0.0.1", "tcp://127.0.0.1:", "tcp://:5555", "tcp://127.0.0.1:0", "tcp://127.0.0.1:65534",
        "tcp://127.0.0.1:55x5", "tcp://127.0.0.1:-1", "tcp://127.0.0.1:*", "tcp://127.0.0.1:99999999999",
        "tcp://[::1]:5555", "ipc:///tmp/a b", "tcp://127.0.0.1:5555 "})
    EXPECT_THROW(Endpoint::parse(bad, true), InputError) << bad;
}

TEST(Endpoint, RefusesAPathThatNoSocketCanHave) {
  EXPECT_NO_THROW(Endpoint::parse("ipc:///" + std::string(98, 'a')));
  EXPECT_THAT([] { Endpoint::parse("ipc:///" + std::string(99, 'a')); },
              ThrowsMessage<InputError>(HasSubstr("has 100 characters, a socket's may have 99")));
}

TEST(PrivateEndpoint, LiesInADirectoryForItsOwnerAlone) {
  const std::filesystem::path socket = private_endpoint().substr(6);
  struct stat status {};
  ASSERT_EQ(stat(socket.parent_path().c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777, 0700U);
  EXPECT_TRUE(std::filesystem::is_empty(socket.parent_path()));
  std::filesystem::remove(socket.parent_path());
}

TEST(EndpointLock, AdmitsOneServer) {
  const TemporaryDirectory directory;
  const auto endpoint = Endpoint::parse(directory.endpoint("server"));
  {
    const EndpointLock held(endpoint);
    EXPECT_THAT([&] { const EndpointLock second(endpoint); },
                ThrowsMessage<InputError>(
                    AllOf(HasSubstr(endpoint.exchange), HasSubstr("in use by another server"))));
    EXPECT_THROW(const EndpointLock third(endpoint), InputError);  // the refusal did not free it
  }
  EXPECT_NO_THROW(const EndpointLock next(endpoint));
}

TEST(EndpointLock, TakesOverWhatACrashedServerLeft) {
  const TemporaryDirectory directory;
  for (const char* name : {"server", "server.publish", "server.record", "server.lock"})
    (void)directory.write(name, "");
  { const EndpointLock lock(Endpoint::parse(directory.endpoint("server"))); }
  EXPECT_TRUE(std::filesystem::is_empty(directory.path()));
}

TEST(EndpointLock, NamesADirectoryThatIsNotThere) {
  const TemporaryDirectory directory;
  const auto endpoint = Endpoint::parse(directory.endpoint("absent/server"));
  EXPECT_THAT([&] { const EndpointLock lock(endpoint); },
              ThrowsMessage<InputError>(HasSubstr("absent/server.lock: No such file")));
}

TEST(EndpointLock, LeavesTcpAlone) {
  EXPECT_NO_THROW(const EndpointLock lock(Endpoint::parse("tcp://127.0.0.1:5555")));
}

TEST(Bind, MakesASocketForItsOwnerAlone) {
  const TemporaryDirectory directory;
  zmq::context_t context;
  auto socket = make_socket(context, zmq::socket_type::router);
  protocol::bind(socket, directory.endpoint("server"));
  struct stat status {};
  ASSERT_EQ(stat((directory / "server").c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777, 0600U);
}

TEST(Bind, NamesAPortInUse) {
  zmq::context_t context;
  auto first = make_socket(context, zmq::socket_type::router);
  first.bind("tcp://127.0.0.1:*");
  const std::string taken = first.get(zmq::sockopt::last_endpoint);
  auto second = make_socket(context, zmq::socket_type::router);
  EXPECT_THAT(
      [&] { protocol::bind(second, taken); },
      ThrowsMessage<InputError>(AllOf(HasSubstr(taken), HasSubstr("in use"), HasSubstr("choose another"))));
}

TEST(Bind, NamesADirectoryThatIsNotThere) {
  const TemporaryDirectory directory;
  zmq::context_t context;
  auto socket = make_socket(context, zmq::socket_type::router);
  EXPECT_THROW(protocol::bind(socket, directory.endpoint("absent/server")), InputError);
}

}  // namespace
}  // namespace sluice::protocol
