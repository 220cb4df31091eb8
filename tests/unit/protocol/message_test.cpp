#include "protocol/message.hpp"

#include <gmock/gmock.h>
#include <xxhash.h>

#include <array>
#include <numeric>

namespace sluice::protocol {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr std::array kDoubles{1.0, -2.5, 3e300, 0.0, 5.0, 6.0};
constexpr std::array kIntegers{std::int32_t{7}, std::int32_t{-8}};

Message example() {
  Message message;
  message.header.set_step(42);
  message.add_array<double>("kinematics", kDoubles, {1, 2, 3});
  message.add_array<std::int32_t>("body", kIntegers, {2});
  return message;
}

TEST(Message, GivesBackItsArrays) {
  const Message message = example();
  EXPECT_THAT(message.array<double>("kinematics"), ElementsAre(1.0, -2.5, 3e300, 0.0, 5.0, 6.0));
  EXPECT_THAT(message.array<std::int32_t>("body"), ElementsAre(7, -8));
  EXPECT_THAT(message.shape("kinematics"), ElementsAre(1, 2, 3));
  EXPECT_TRUE(message.has_array("body"));
  EXPECT_FALSE(message.has_array("bod"));
}

TEST(Message, HoldsEmptyArrays) {
  Message message;
  message.add_array<double>("wrenches", {}, {4, 0, 6});
  EXPECT_TRUE(message.array<double>("wrenches").empty());
  EXPECT_THAT(message.shape("wrenches"), ElementsAre(4, 0, 6));
}

TEST(Message, NamesWhatIsAbsentOrOfAnotherType) {
  const Message message = example();
  EXPECT_THAT([&] { (void)message.array<double>("wrenches"); },
              ThrowsMessage<ProtocolError>("the message has no array wrenches"));
  EXPECT_THAT([&] { (void)message.array<float>("kinematics"); },
              ThrowsMessage<ProtocolError>("array kinematics has type FLOAT64, expected FLOAT32"));
  EXPECT_THROW((void)message.shape("wrenches"), ProtocolError);
}

TEST(Message, RefusesAShapeThatIsNotItsData) {
  Message message;
  EXPECT_THAT([&] { message.add_array<double>("a", kDoubles, {5}); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("6 values do not fill its shape [5]")));
  EXPECT_THROW(message.add_array<double>("a", {}, {std::uint64_t{1} << 40, std::uint64_t{1} << 40}),
               std::invalid_argument);
  EXPECT_TRUE(message.frames.empty());
}

TEST(Message, CloneIsEqualAndApart) {
  Message message = example();
  const Message copy = message.clone();
  *static_cast<double*>(message.frames[0].data()) = 9;
  EXPECT_EQ(copy.header.SerializeAsString(), message.header.SerializeAsString());
  EXPECT_EQ(copy.array<double>("kinematics")[0], 1.0);
  EXPECT_NE(copy.hash_arrays(), message.hash_arrays());
}

TEST(Message, HashIsXxh3OfAllBytesInOrder) {
  const Message message = example();
  std::string bytes(reinterpret_cast<const char*>(kDoubles.data()), sizeof kDoubles);
  bytes.append(reinterpret_cast<const char*>(kIntegers.data()), sizeof kIntegers);
  EXPECT_EQ(message.hash_arrays(), XXH3_64bits(bytes.data(), bytes.size()));
}

}  // namespace
}  // namespace sluice::protocol
