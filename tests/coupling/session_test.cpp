#include "server/session.hpp"

#include <gtest/gtest.h>

#include "tests/coupling/directory.hpp"
#include "tests/coupling/peer.hpp"

namespace sluice::testing {
namespace {

// What lets the server look at its deadlines while a peer floods it.
TEST(Session, TakesInOneMessageACall) {
  Directory directory;
  const protocol::Endpoint endpoint = protocol::Endpoint::parse(directory.endpoint());
  zmq::context_t context;
  zmq::socket_t router = protocol::make_socket(context, zmq::socket_type::router);
  protocol::bind(router, endpoint.exchange);
  server::Session session(router, {.owners = {""}, .recorder = false}, [](const server::Session::Seat&) {
    protocol::Message welcome;
    welcome.header.mutable_welcome();
    return welcome;
  });

  Peer peer(endpoint);
  for (int i = 0; i < 5; ++i) {
    protocol::Message hello;
    hello.header.mutable_hello()->set_role(RIGID);
    peer.send_raw(hello);
  }
  int taken = 0, joined = 0;
  const auto limit = std::chrono::steady_clock::now() + std::chrono::milliseconds(kPatience);
  while (taken < 3 && std::chrono::steady_clock::now() < limit) {
    taken += session.serve([&](const server::Session::Inbound&) { ++joined; });
  }
  ASSERT_EQ(taken, 3);
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(peer.receive().header.has_welcome());
  EXPECT_FALSE(peer.hears_within(100));  // the other two are not taken in yet
  EXPECT_EQ(joined, 1);                  // the same Hello again changes nothing
}

}  // namespace
}  // namespace sluice::testing
