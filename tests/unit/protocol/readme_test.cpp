#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <set>

#include "protocol/endpoint.hpp"
#include "protocol/framing.hpp"
#include "protocol/version.hpp"
#include "temporary_directory.hpp"

namespace sluice::protocol {
namespace {

constexpr int kPatience = 30'000;  // [ms], only to end a test that fails

// The text of the first block in that language.
std::string block(const std::string& language) {
  std::ifstream file(SLUICE_SOURCE "/protocol/README.md");
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  const std::string fence = "```" + language + "\n";
  const std::size_t begin = text.find(fence);
  if (begin == std::string::npos) return {};
  return text.substr(begin + fence.size(), text.find("```", begin + fence.size()) - begin - fence.size());
}

// The client that the page shows, started in a directory of its own.
class Client {
 public:
  Client(const TemporaryDirectory& directory, const std::string& address) {
    std::filesystem::create_directory_symlink(SLUICE_SOURCE "/protocol", directory / "protocol");
    (void)directory.write("client.py", block("python"));
    const std::string command = "exec 2>&1; cd '" + directory.path().string() + "' && " + block("sh") +
                                "exec timeout 60 /usr/bin/python3 client.py " + address;
    output_ = popen(command.c_str(), "r");
  }
  ~Client() { (void)finish(); }
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;

  // What it printed until its end.
  std::string finish() {
    std::string text;
    std::array<char, 256> line{};
    while (output_ != nullptr && fgets(line.data(), line.size(), output_) != nullptr) text += line.data();
    if (output_ != nullptr) pclose(output_);
    output_ = nullptr;
    return text;
  }

 private:
  FILE* output_ = nullptr;
};

class Readme : public testing::Test {
 protected:
  Readme() {
    protocol::bind(exchange_, endpoint_.exchange);
    protocol::bind(publish_, endpoint_.publish);
    publish_.set(zmq::sockopt::rcvtimeo, kPatience);
  }

  static Message message() {
    Message result;
    result.header.set_protocol_version(kProtocolVersion);
    return result;
  }

  // Until both of the client's subscriptions have arrived.
  void await_subscriptions() {
    std::set<std::string> topics;
    zmq::message_t event;
    while (topics.size() < 2 && publish_.recv(event)) topics.insert(event.to_string());
    EXPECT_EQ(topics, (std::set<std::string>{"\1frame", "\1status"}));
  }

  const TemporaryDirectory directory_;
  const Endpoint endpoint_ = Endpoint::parse(directory_.endpoint("server"));
  zmq::context_t context_;
  zmq::socket_t exchange_ = make_socket(context_, zmq::socket_type::router);
  zmq::socket_t publish_ = make_socket(context_, zmq::socket_type::xpub);
};

TEST_F(Readme, ItsClientWatches) {
  Client client(directory_, endpoint_.exchange);
  const auto hello = receive_within(exchange_, kPatience);
  ASSERT_TRUE(hello) << client.finish();
  EXPECT_EQ(hello->message.header.protocol_version(), kProtocolVersion);
  EXPECT_EQ(hello->message.header.hello().role(), WATCHER);

  await_subscriptions();
  Message frame = message();
  frame.header.set_time_ns(250'000'000);
  frame.header.mutable_frame()->set_index(1);
  const std::array velocities{0.0, 0.0, 0.0, 3.0, 4.0, 0.0};
  frame.add_array<double>("fluid/velocity", velocities, {2, 3});
  EXPECT_TRUE(send(publish_, frame, "frame"));
  Message end = message();
  end.header.mutable_end()->set_reason(End::FINISHED);
  EXPECT_TRUE(send(publish_, end, "status"));

  Message welcome = message();
  welcome.header.mutable_welcome()->mutable_scene()->set_name("tank");
  EXPECT_TRUE(send(exchange_, welcome, hello->identity));
  EXPECT_EQ(client.finish(), "tank\n0.25 5.0\n");
}

TEST_F(Readme, ItsClientSaysWhyItWasRefused) {
  Client client(directory_, endpoint_.exchange);
  const auto hello = receive_within(exchange_, kPatience);
  ASSERT_TRUE(hello) << client.finish();
  Message refusal = message();
  refusal.header.mutable_refusal()->set_reason("not today");
  EXPECT_TRUE(send(exchange_, refusal, hello->identity));
  EXPECT_EQ(client.finish(), "not today\n");
}

}  // namespace
}  // namespace sluice::protocol
