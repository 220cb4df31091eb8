#include "server/exchange.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <numeric>

#include "server/stop.hpp"

namespace sluice::testing {
namespace {

using protocol::Message;

Message kinematics(std::uint64_t sequence, std::uint64_t first, std::uint32_t count) {
  std::vector<double> rows;
  for (std::uint32_t i = 0; i < count; ++i) {
    fluid::Kinematics k;
    k.position.x() = static_cast<double>(first + i);
    server::append(rows, k);
  }
  Message message;
  message.header.set_sequence(sequence);
  message.header.mutable_kinematics()->set_first_step(first);
  message.header.mutable_kinematics()->set_count(count);
  message.add_array<double>("kinematics", rows, {count, 1, server::kKinematicsRow});
  return message;
}

// Answers a step of one body with the force (step, 0, 0).
std::optional<Message> answer(server::Exchange& exchange, std::uint64_t step) {
  fluid::Wrench wrench;
  wrench.force.x() = static_cast<double>(step);
  return exchange.answer(step, std::vector<fluid::Wrench>{wrench});
}

TEST(Exchange, AnswersABatchWhenItsLastStepIsDone) {
  server::Exchange exchange(1, 10, {.lock_step = false});
  EXPECT_FALSE(exchange.has(1));
  exchange.accept(kinematics(1, 1, 3));
  ASSERT_TRUE(exchange.has(1));
  EXPECT_EQ(exchange.rows(1)[0], 1);
  EXPECT_FALSE(answer(exchange, 1));
  EXPECT_EQ(exchange.rows(2)[0], 2);
  EXPECT_FALSE(answer(exchange, 2));
  const auto reply = answer(exchange, 3);
  ASSERT_TRUE(reply);
  EXPECT_EQ(reply->header.sequence(), 1u);
  EXPECT_EQ(reply->shape("wrenches"), (std::vector<std::uint64_t>{3, 1, 6}));
  EXPECT_EQ(reply->array<double>("wrenches")[12], 3);
  EXPECT_FALSE(exchange.has(4));
}

TEST(Exchange, HoldsTwoBatchesAndRefusesTheThird) {
  server::Exchange exchange(1, 100, {.lock_step = false});
  exchange.accept(kinematics(1, 1, 2));
  exchange.accept(kinematics(2, 3, 2));
  EXPECT_THROW(exchange.accept(kinematics(3, 5, 2)), server::Refused);
  answer(exchange, 1);
  answer(exchange, 2);
  exchange.accept(kinematics(3, 5, 2));
  EXPECT_TRUE(exchange.has(3));
}

TEST(Exchange, KeepsTheLastRepliesAndRefusesOlderOnes) {
  server::Exchange exchange(1, 100, {.lock_step = false});
  for (std::uint64_t n = 1; n <= 3; ++n) {
    exchange.accept(kinematics(n, n, 1));
    answer(exchange, n);
  }
  EXPECT_EQ(exchange.accept(kinematics(3, 3, 1)).value().array<double>("wrenches")[0], 3);
  EXPECT_EQ(exchange.accept(kinematics(2, 2, 1)).value().array<double>("wrenches")[0], 2);
  EXPECT_THROW(exchange.accept(kinematics(1, 1, 1)), server::Refused);
}

TEST(Exchange, ARepeatedMessageThatWaitsForItsAnswerChangesNothing) {
  server::Exchange exchange(1, 100, {.lock_step = false});
  exchange.accept(kinematics(1, 1, 1));
  EXPECT_FALSE(exchange.accept(kinematics(1, 1, 1)));
  EXPECT_TRUE(answer(exchange, 1));
  EXPECT_FALSE(exchange.has(2));
}

TEST(Exchange, CapsTheStepsOfAMessage) {
  server::Exchange exchange(1, 1000, {.lock_step = false});
  EXPECT_THROW(exchange.accept(kinematics(1, 1, 257)), server::Refused);
  EXPECT_FALSE(exchange.accept(kinematics(1, 1, 256)));
}

TEST(KinematicsRows, RoundTripBitForBit) {
  std::vector<double> row(19);
  std::iota(row.begin(), row.end(), 0.1);
  std::vector<double> back;
  server::append(back, server::read_kinematics(row));
  EXPECT_EQ(back, row);
}

TEST(ExitCodes, FollowTheReason) {
  EXPECT_EQ(server::exit_code(End::FINISHED), 0);
  EXPECT_EQ(server::exit_code(End::UNSTABLE), 3);
  for (const End::Reason reason : {End::PARTICIPANT_LOST, End::PARTICIPANT_TIMEOUT, End::RECORDER_LOST,
                                   End::INTERRUPTED, End::PROTOCOL_ERROR, End::UNKNOWN}) {
    EXPECT_EQ(server::exit_code(reason), 2);
  }
}

Message iteration(std::uint64_t sequence, std::uint64_t first, std::uint32_t count, std::uint32_t iteration) {
  Message message = kinematics(sequence, first, count);
  message.header.mutable_kinematics()->set_iteration(iteration);
  return message;
}

Accepted accepted(std::uint64_t first, std::uint32_t count) {
  Accepted content;
  content.set_first_step(first);
  content.set_count(count);
  content.set_iterations(2);
  content.set_residual(0.25);
  return content;
}

TEST(Exchange, TakesSeveralStepsInLockStepUpToAnOutput) {
  server::Exchange exchange(1, 100, {.lock_step = true, .steps_per_exchange = 4, .steps_per_output = 10});
  EXPECT_THROW(exchange.accept(kinematics(1, 1, 5)), server::Refused);
  std::uint64_t sequence = 0;
  for (const std::uint64_t first : {1, 5}) {
    exchange.accept(kinematics(++sequence, first, 4));
    EXPECT_EQ(exchange.last_step(), first + 3);
    for (std::uint64_t step = first; step < first + 4; ++step) answer(exchange, step);
  }
  EXPECT_THROW(exchange.accept(kinematics(3, 9, 4)), server::Refused);
  EXPECT_NO_THROW(exchange.accept(kinematics(3, 9, 2)));
}

TEST(Exchange, RepeatsAnExchangeUntilItIsAccepted) {
  server::Exchange exchange(1, 100, {.lock_step = true, .steps_per_output = 10, .is_iterated = true});
  exchange.accept(kinematics(1, 1, 1));
  answer(exchange, 1);
  EXPECT_FALSE(exchange.is_decided());
  exchange.accept(iteration(2, 1, 1, 1));
  EXPECT_TRUE(exchange.is_decided());
  EXPECT_TRUE(exchange.is_repeated());
  ASSERT_TRUE(exchange.has(1));
  answer(exchange, 1);
  EXPECT_FALSE(exchange.is_decided());
  exchange.accept_exchange(accepted(1, 1));
  EXPECT_TRUE(exchange.is_decided());
  EXPECT_FALSE(exchange.is_repeated());
  EXPECT_EQ(exchange.accepted().residual(), 0.25);
  EXPECT_NO_THROW(exchange.accept(kinematics(3, 2, 1)));
}

TEST(Exchange, RefusesWhatIsNotThatExchange) {
  server::Exchange exchange(1, 100, {.lock_step = true, .steps_per_output = 10, .is_iterated = true});
  EXPECT_THROW(exchange.accept(iteration(1, 1, 1, 1)), server::Refused) << "nothing to repeat";
  EXPECT_THROW(exchange.accept_exchange(accepted(1, 1)), server::Refused) << "nothing to accept";
  exchange.accept(kinematics(1, 1, 1));
  answer(exchange, 1);
  EXPECT_THROW(exchange.accept(kinematics(2, 2, 1)), server::Refused) << "not accepted yet";
  EXPECT_THROW(exchange.accept(iteration(2, 1, 1, 2)), server::Refused) << "an iteration left out";
  EXPECT_THROW(exchange.accept(iteration(2, 2, 1, 1)), server::Refused) << "other steps";
  EXPECT_THROW(exchange.accept_exchange(accepted(2, 1)), server::Refused);
  Accepted not_finite = accepted(1, 1);
  not_finite.set_residual(std::numeric_limits<double>::infinity());
  EXPECT_THROW(exchange.accept_exchange(not_finite), server::Refused);
  EXPECT_NO_THROW(exchange.accept_exchange(accepted(1, 1)));
}

}  // namespace
}  // namespace sluice::testing
