#include "protocol/framing.hpp"

#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

#include <array>

#include "protocol/endpoint.hpp"
#include "temporary_directory.hpp"

namespace sluice::protocol {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr int kPatience = 10'000;  // [ms], only to end a test that fails

Message example() {
  Message message;
  message.header.set_sequence(3);
  message.header.mutable_kinematics()->set_first_step(1);
  const std::array values{1.0, 2.0, 3.0};
  message.add_array<double>("kinematics", values, {1, 1, 3});
  return message;
}

// Two sockets that reach each other within the process.
class Pipe {
 public:
  explicit Pipe(zmq::socket_type to = zmq::socket_type::pair, zmq::socket_type from = zmq::socket_type::pair)
      : receiver(make_socket(context_, to)), sender(make_socket(context_, from)) {
    receiver.bind("inproc://pipe");
    sender.connect("inproc://pipe");
  }

  void send_raw(const std::vector<std::string>& frames) {
    for (std::size_t i = 0; i < frames.size(); ++i)
      sender.send(zmq::buffer(frames[i]),
                  i + 1 < frames.size() ? zmq::send_flags::sndmore : zmq::send_flags::none);
  }

 private:
  zmq::context_t context_;

 public:
  zmq::socket_t receiver, sender;
};

void expect_example(const std::optional<Received>& received) {
  ASSERT_TRUE(received);
  EXPECT_EQ(received->message.header.sequence(), 3U);
  EXPECT_THAT(received->message.array<double>("kinematics"), ElementsAre(1.0, 2.0, 3.0));
}

TEST(Framing, RoundTrip) {
  Pipe pipe;
  EXPECT_FALSE(receive(pipe.receiver));
  EXPECT_TRUE(send(pipe.sender, example()));
  expect_example(receive_within(pipe.receiver, kPatience));
  EXPECT_FALSE(receive_within(pipe.receiver, 0));
}

TEST(Framing, SameMessageCanBeSentAgain) {
  Pipe pipe;
  const Message message = example();
  for (int i = 0; i < 3; ++i) {
    EXPECT_TRUE(send(pipe.sender, message));
    expect_example(receive(pipe.receiver));
  }
}

TEST(Framing, RouterAnswersTheIdentityThatAsked) {
  Pipe pipe(zmq::socket_type::router, zmq::socket_type::dealer);
  send(pipe.sender, example());
  const auto request = receive_within(pipe.receiver, kPatience);
  expect_example(request);
  EXPECT_TRUE(send(pipe.receiver, example(), request->identity));
  expect_example(receive_within(pipe.sender, kPatience));
}

TEST(Framing, RouterSaysThatAPeerIsGone) {
  Pipe pipe(zmq::socket_type::router, zmq::socket_type::dealer);
  EXPECT_FALSE(send(pipe.receiver, example(), "nobody"));
}

TEST(Framing, SenderWithoutAPeerWouldBlock) {
  zmq::context_t context;
  zmq::socket_t socket = make_socket(context, zmq::socket_type::push);
  EXPECT_FALSE(send(socket, example()));
}

TEST(Framing, TopicReachesItsSubscriber) {
  Pipe pipe(zmq::socket_type::xpub, zmq::socket_type::sub);
  pipe.sender.set(zmq::sockopt::subscribe, "frame");
  zmq::message_t subscription;
  ASSERT_TRUE(pipe.receiver.recv(subscription));
  EXPECT_TRUE(send(pipe.receiver, example(), "status"));
  EXPECT_TRUE(send(pipe.receiver, example(), "frame"));
  const auto received = receive_within(pipe.sender, kPatience);
  expect_example(received);
  EXPECT_EQ(received->identity, "frame");
}

// Small frames come out of one read buffer at any address; undefined behaviour would show under asan.
TEST(Framing, ArraysAreAlignedAfterATransport) {
  const TemporaryDirectory directory;
  zmq::context_t context;
  zmq::socket_t pull = make_socket(context, zmq::socket_type::pull);
  zmq::socket_t push = make_socket(context, zmq::socket_type::push);
  protocol::bind(pull, directory.endpoint("pull"));
  push.connect(directory.endpoint("pull"));
  const std::vector<double> values(50, 1.5);
  for (std::size_t length = 0; length < 16; ++length) {
    Message message;
    message.header.set_run_id(std::string(length, 'x'));
    message.add_array<double>("wrenches", values, {50});
    send(push, message);
  }
  for (int i = 0; i < 16; ++i) {
    const auto received = receive_within(pull, kPatience);
    ASSERT_TRUE(received);
    const auto array = received->message.array<double>("wrenches");
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(array.data()) % alignof(double), 0U);
    EXPECT_EQ(array.back(), 1.5);
  }
}

// What the header says and what follows it, apart from the error.
struct Broken {
  const char* name;
  void (*spoil)(Header& header, std::vector<std::string>& frames);
  const char* error;
};

void PrintTo(const Broken& broken, std::ostream* out) {
  *out << broken.name;
}

class FramingRefuses : public testing::TestWithParam<Broken> {};

TEST_P(FramingRefuses, AndReadsTheNextMessage) {
  Pipe pipe;
  Message message = example();
  std::vector<std::string> frames{message.frames[0].to_string()};
  GetParam().spoil(message.header, frames);
  frames.insert(frames.begin(), message.header.SerializeAsString());
  pipe.send_raw(frames);
  send(pipe.sender, example());
  EXPECT_THAT([&] { receive(pipe.receiver); }, ThrowsMessage<ProtocolError>(HasSubstr(GetParam().error)));
  expect_example(receive(pipe.receiver));
}

const std::array kBroken{
    Broken{"MissingFrame", [](Header&, auto& frames) { frames.clear(); }, "announces 1 arrays, 0 came"},
    Broken{"ExtraFrame", [](Header&, auto& frames) { frames.emplace_back("x"); },
           "announces 1 arrays, 2 came"},
    Broken{"ShortFrame", [](Header&, auto& frames) { frames[0].pop_back(); },
           "does not match its frame of 23 bytes"},
    Broken{"UnknownType", [](Header& h, auto&) { h.mutable_array(0)->set_type(Array::UNKNOWN); },
           "unknown type 0"},
    Broken{"LaterType", [](Header& h, auto&) { h.mutable_array(0)->set_type(static_cast<Array::Type>(99)); },
           "unknown type 99"},
    Broken{"Overflow",  // 3 * 2^64 + 3 elements, which is 3 modulo 2^64
           [](Header& h, auto&) {
             h.mutable_array(0)->clear_shape();
             for (const std::uint64_t n : {std::uint64_t{3}, (~std::uint64_t{0} / 3) * 2 + 2})
               h.mutable_array(0)->add_shape(n);
           },
           "does not match its frame"},
    Broken{"OverflowBesideZero",
           [](Header& h, auto& frames) {
             h.mutable_array(0)->clear_shape();
             for (const std::uint64_t n : {~std::uint64_t{0}, ~std::uint64_t{0}, std::uint64_t{0}})
               h.mutable_array(0)->add_shape(n);
             frames[0].clear();
           },
           "does not match its frame"},
    Broken{"ManyExtents",
           [](Header& h, auto&) {
             for (int i = 0; i < 9; ++i) h.mutable_array(0)->add_shape(1);
           },
           "extents, allowed are 8"},
    Broken{"NoName", [](Header& h, auto&) { h.mutable_array(0)->clear_name(); }, "0 characters"},
    Broken{"LongName", [](Header& h, auto&) { h.mutable_array(0)->set_name(std::string(129, 'n')); },
           "129 characters"},
    Broken{"SameName",
           [](Header& h, auto& frames) {
             *h.add_array() = h.array(0);
             frames.push_back(frames[0]);
           },
           "two arrays are named kinematics"},
    Broken{"ManyFrames",
           [](Header& h, auto& frames) {
             for (int i = 0; i < 100; ++i) {
               *h.add_array() = h.array(0);
               frames.push_back(frames[0]);
             }
           },
           "a message of 102 frames"},
    Broken{"LongHeader", [](Header& h, auto&) { h.set_run_id(std::string(1 << 20, 'x')); },
           "a header of 10486"},
    Broken{"NotAHeader",
           [](Header& h, auto& frames) {
             h.Clear();
             frames = {"\xff\xff", "x"};
           },
           "announces 0 arrays, 2 came"},
};
INSTANTIATE_TEST_SUITE_P(Messages, FramingRefuses, testing::ValuesIn(kBroken),
                         [](const auto& test) { return test.param.name; });

TEST(Framing, RefusesBytesThatAreNoHeader) {
  Pipe pipe;
  pipe.send_raw({"\xff\xff\xff"});
  EXPECT_THAT([&] { receive(pipe.receiver); }, ThrowsMessage<ProtocolError>("3 bytes that are not a header"));
}

TEST(Framing, RefusesMoreBytesThanAllowed) {
  Pipe pipe;
  send(pipe.sender, example());
  Limits limits;
  limits.total_bytes = 30;
  EXPECT_THAT([&] { receive(pipe.receiver, limits); },
              ThrowsMessage<ProtocolError>(HasSubstr("allowed are 64 and 30")));
}

TEST(Framing, RefusesAnIdentityAlone) {
  Pipe pipe(zmq::socket_type::router, zmq::socket_type::dealer);
  pipe.send_raw({""});
  // an empty frame is an empty header: an unknown version, for the server to refuse
  const auto received = receive_within(pipe.receiver, kPatience);
  ASSERT_TRUE(received);
  EXPECT_EQ(received->message.header.protocol_version(), 0U);
}

// Either a valid message or a ProtocolError, and the next message is read as if nothing had happened.
void survives(Pipe& pipe, const std::vector<std::string>& frames) {
  pipe.send_raw(frames);
  try {
    const auto received = receive(pipe.receiver);
    RC_ASSERT(received.has_value());
    RC_ASSERT(received->message.frames.size() + 1 == frames.size());
  } catch (const ProtocolError& error) {
    RC_ASSERT(std::string(error.what()).size() < 1000U);
  }
  send(pipe.sender, example());
  const auto next = receive(pipe.receiver);
  RC_ASSERT(next.has_value());
  RC_ASSERT(next->message.header.sequence() == 3U);
  RC_ASSERT(!receive(pipe.receiver));
}

RC_GTEST_PROP(FramingFuzz, RandomFrames, ()) {
  Pipe pipe;
  const auto frames =
      *rc::gen::nonEmpty(rc::gen::container<std::vector<std::string>>(rc::gen::arbitrary<std::string>()));
  survives(pipe, frames);
}

RC_GTEST_PROP(FramingFuzz, DamagedHeader, ()) {
  Pipe pipe;
  const Message message = example();
  std::string header = message.header.SerializeAsString();
  const auto hits = *rc::gen::inRange(1, 5);
  for (int i = 0; i < hits; ++i)
    header[*rc::gen::inRange<std::size_t>(0, header.size())] = *rc::gen::arbitrary<char>();
  header.resize(*rc::gen::inRange<std::size_t>(0, header.size() + 1));
  survives(pipe, {header, message.frames[0].to_string()});
}

RC_GTEST_PROP(FramingFuzz, ArraysThatDisagree, ()) {
  Pipe pipe;
  Header header;
  std::vector<std::string> frames;
  const int announced = *rc::gen::inRange(0, 5);
  for (int i = 0; i < announced; ++i) {
    Array& array = *header.add_array();
    array.set_name(*rc::gen::element<std::string>("a", "b", "c", ""));
    array.set_type(static_cast<Array::Type>(*rc::gen::inRange(-1, 8)));
    for (const auto extent :
         *rc::gen::container<std::vector<std::uint64_t>>(rc::gen::arbitrary<std::uint64_t>()))
      array.add_shape(extent);
  }
  const int sent = *rc::gen::inRange(0, 5);
  for (int i = 0; i < sent; ++i) frames.emplace_back(*rc::gen::inRange<std::size_t>(0, 100), 'x');
  frames.insert(frames.begin(), header.SerializeAsString());
  survives(pipe, frames);
}

}  // namespace
}  // namespace sluice::protocol
