#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <future>

#include "clients/record/connection.hpp"
#include "clients/replay/comparison.hpp"
#include "clients/replay/publication.hpp"
#include "protocol/framing.hpp"
#include "protocol/version.hpp"
#include "tests/unit/clients/fake_run.hpp"

namespace sluice::clients::test {
namespace {

using testing::HasSubstr;

constexpr int kPatience = 20000;  // [ms]

class PublicationTest : public testing::Test {
 protected:
  void SetUp() override {
    record(run_, directory_ / "run.h5");
    options_.endpoint = "ipc://" + (directory_ / "replay").string();
    options_.speed = 10;  // 0.2 s of frames
  }
  std::future<void> start() {
    return std::async(std::launch::async,
                      [this] { publish(Reader(directory_ / "run.h5"), options_, stop_); });
  }
  void subscribe() {
    for (const char* topic : {"status", "frame"}) news_.set(zmq::sockopt::subscribe, topic);
    news_.connect(options_.endpoint + ".publish");
  }
  // The answer to a client in that role.
  protocol::Message greet(Connection& connection, Role role) {
    connection.greet(role, "test");
    zmq::pollitem_t item = connection.poll_item();
    while (true) {
      wait_for_any({&item, 1}, std::chrono::milliseconds(kPatience));
      if (auto message = connection.receive()) return std::move(*message);
    }
  }

  const TemporaryDirectory directory_;
  const FakeRun run_{};
  PublicationOptions options_;
  std::atomic<bool> stop_{false};
  zmq::context_t context_;
  zmq::socket_t news_ = protocol::make_socket(context_, zmq::socket_type::sub);
};

// Frames that a watcher does not fetch in time are dropped, as the server's are: those that come must be
// right and in order.
TEST_F(PublicationTest, GivesAWatcherWhatTheServerGave) {
  auto replay = start();
  Connection connection(context_, protocol::Endpoint::parse(options_.endpoint), {});
  protocol::Message welcome = greet(connection, WATCHER);
  EXPECT_EQ(welcome.header.welcome().publish_endpoint(), options_.endpoint + ".publish");
  EXPECT_EQ(welcome.hash_arrays(), run_.welcome().hash_arrays());
  subscribe();
  std::uint64_t next = 0, seen = 0;
  bool status = false;
  std::optional<End> end;
  while (!end) {
    auto received = protocol::receive_within(news_, kPatience);
    ASSERT_TRUE(received) << "after frame " << next;
    Header& header = received->message.header;
    EXPECT_EQ(header.run_id(), "fake-run");
    EXPECT_EQ(received->identity, header.has_frame() ? "frame" : "status");
    status = status || header.has_status();
    if (header.has_frame()) {
      const std::uint64_t index = header.frame().index();
      ASSERT_GE(index, next);
      ASSERT_LE(index, run_.frames);
      expect_same(received->message, run_.frame(index));
      next = index + 1;
      ++seen;
    }
    if (header.has_end()) end = header.end();
  }
  EXPECT_GT(seen, run_.frames / 2);
  EXPECT_TRUE(status);
  EXPECT_EQ(end->reason(), End::FINISHED);
  EXPECT_EQ(end->detail(), "all steps done");
  replay.get();
}

TEST_F(PublicationTest, ObeysWhoeverIsAtTheControls) {
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  options_.control = ends[0];
  options_.speed = 1e-6;
  auto replay = start();
  subscribe();
  const auto next_frame = [&]() -> std::uint64_t {
    while (auto received = protocol::receive_within(news_, kPatience))
      if (received->message.header.has_frame()) return received->message.header.frame().index();
    return ~std::uint64_t{0};
  };
  const auto tell = [&](const std::string& text) {
    EXPECT_EQ(write(ends[1], text.data(), text.size()), static_cast<ssize_t>(text.size()));
  };
  EXPECT_EQ(next_frame(), 0u);
  tell("step 2\n");
  EXPECT_EQ(next_frame(), 1u);
  EXPECT_EQ(next_frame(), 2u);
  tell("nonsense\nseek 0.1\nst");
  EXPECT_EQ(next_frame(), 10u);
  tell("ep -1\n");
  EXPECT_EQ(next_frame(), 9u);
  tell("quit\n");
  replay.get();
  close(ends[0]);
  close(ends[1]);
}

TEST_F(PublicationTest, WaitsForAWatcherUntilItIsStopped) {
  auto replay = start();
  Connection connection(context_, protocol::Endpoint::parse(options_.endpoint), {});
  greet(connection, WATCHER);  // it is there, and nobody has subscribed
  stop_ = true;
  replay.get();
}

TEST_F(PublicationTest, RefusesOtherRoles) {
  auto replay = start();
  Connection connection(context_, protocol::Endpoint::parse(options_.endpoint), {});
  try {
    greet(connection, RIGID);
    FAIL();
  } catch (const protocol::ProtocolError& error) {
    EXPECT_THAT(error.what(), HasSubstr("only watchers can join"));
  }
  stop_ = true;
  replay.get();
}

TEST_F(PublicationTest, RefusesAnotherVersion) {
  auto replay = start();
  zmq::socket_t peer = protocol::make_socket(context_, zmq::socket_type::dealer);
  peer.connect(options_.endpoint);
  protocol::Message hello;
  hello.header.set_protocol_version(protocol::kProtocolVersion + 1);
  hello.header.mutable_hello()->set_role(WATCHER);
  protocol::send(peer, hello);
  const auto answer = protocol::receive_within(peer, kPatience);
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->message.header.refusal().code(), Refusal::VERSION_MISMATCH);
  stop_ = true;
  replay.get();
}

TEST(Comparison, FindsTheFirstBitThatDiffers) {
  const FakeRun run{.bodies = 2};
  const Scene scene = run.welcome().header.welcome().scene();
  EXPECT_EQ(first_difference(run.frame(3), run.frame(3), scene), std::nullopt);
  EXPECT_EQ(first_difference(run.exchange_log(3), run.exchange_log(3), scene), std::nullopt);

  const auto flipped = [](protocol::Message message, int array, std::size_t element) {
    static_cast<char*>(message.frames[static_cast<std::size_t>(array)].data())[8 * element] ^= 1;
    return message;
  };
  const auto difference = [&](const protocol::Message& message, int array, std::size_t element) {
    return first_difference(message, flipped(message.clone(), array, element), scene).value_or("none");
  };
  EXPECT_THAT(difference(run.frame(3), 0, 3 * 17 + 1),
              HasSubstr("fluid/position y of particle 17: recorded "));
  EXPECT_THAT(difference(run.frame(3), 3, 49), HasSubstr("fluid/pressure of particle 49"));
  EXPECT_THAT(difference(run.frame(3), 5, 6 + 1), HasSubstr("force y of body body1"));
  EXPECT_THAT(difference(run.exchange_log(2), 0, 2 * 19 + 3),
              HasSubstr("orientation w of body body0 at step 5"));
  EXPECT_THAT(difference(run.exchange_log(2), 1, 17), HasSubstr("moment z of body body0 at step 5"));

  protocol::Message other = run.frame(3);
  other.header.mutable_frame()->mutable_energy()->set_kinetic(1);
  EXPECT_THAT(first_difference(run.frame(3), other, scene).value_or("none"), HasSubstr("energy kinetic"));
}

}  // namespace
}  // namespace sluice::clients::test
