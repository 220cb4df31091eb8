#include "clients/rigid/participant.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <future>

#include "clients/rigid/participant_link.hpp"
#include "protocol/endpoint.hpp"
#include "protocol/framing.hpp"
#include "protocol/sim_time.hpp"
#include "protocol/version.hpp"

namespace sluice::clients {
namespace {

using protocol::Message;
using protocol::Received;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr protocol::Nanoseconds kInterval = 1'000'000;
constexpr std::uint64_t kToken = 77;

// The server's side of the exchange, played by hand, against a participant in a thread of its own.
class ParticipantTest : public testing::Test {
 protected:
  ParticipantTest() : router_(protocol::make_socket(context_, zmq::socket_type::router)) {
    std::string name = (std::filesystem::temp_directory_path() / "participant-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("mkdtemp");
    directory_ = name;
    endpoint_ = "ipc://" + (directory_ / "server").string();
    protocol::bind(router_, endpoint_);
    scene_.set_name("test");
    scene_.set_dimension(2);
    scene_.set_spacing(0.01);
    scene_.set_duration(1);
    scene_.mutable_domain()->add_max(10);
    scene_.mutable_domain()->add_max(10);
  }
  ~ParticipantTest() override {
    stop_ = true;  // lets a participant go that a failed test has left waiting
    if (participant_.valid()) participant_.wait();
    std::filesystem::remove_all(directory_);
  }

  Body& add_body() {
    Body& body = *scene_.add_body();
    body.set_name("body" + std::to_string(scene_.body_size()));
    body.mutable_ball()->set_radius(0.1);
    body.add_position(5);
    body.add_position(5);
    return body;
  }

  void start() {
    participant_ =
        std::async(std::launch::async, [this] { return take_part_as_rigid(endpoint_, {}, stop_); });
  }

  Message receive() {
    while (auto received = protocol::receive_within(router_, 5000)) {
      peer_ = received->identity;
      if (!received->message.header.has_heartbeat()) return std::move(received->message);
    }
    throw std::runtime_error("nothing came from the participant in 5 s");
  }

  void reply(Message message) {
    message.header.set_protocol_version(protocol::kProtocolVersion);
    message.header.set_run_id("run");
    message.header.set_session_token(kToken);
    ASSERT_TRUE(protocol::send(router_, message, peer_));
  }

  void welcome(std::uint64_t steps) {
    const Message hello = receive();
    EXPECT_EQ(hello.header.hello().role(), RIGID);
    EXPECT_EQ(hello.header.protocol_version(), protocol::kProtocolVersion);
    Message message;
    *message.header.mutable_welcome()->mutable_scene() = scene_;
    message.header.mutable_welcome()->set_interval_ns(kInterval);
    message.header.mutable_welcome()->set_steps_per_interval(10);
    message.header.mutable_welcome()->set_steps(steps);
    for (const std::uint32_t body : own_) message.header.mutable_welcome()->add_body(body);
    add_wrenches(message, 1, {});
    reply(std::move(message));
  }

  void add_wrenches(Message& message, std::size_t count, const std::vector<double>& force) {
    const std::size_t bodies = own_.empty() ? static_cast<std::size_t>(scene_.body_size()) : own_.size();
    std::vector<double> rows(count * bodies * 6, 0.0);
    for (std::size_t i = 0; i < force.size(); ++i) rows[i] = force[i];
    message.add_array<double>("wrenches", rows, {count, bodies, 6});
  }

  void answer(const Kinematics& asked, const std::vector<double>& force = {}) {
    Message message;
    message.header.mutable_wrenches()->set_first_step(asked.first_step());
    message.header.mutable_wrenches()->set_count(asked.count());
    add_wrenches(message, asked.count(), force);
    reply(std::move(message));
  }

  void end(End::Reason reason) {
    Message message;
    message.header.mutable_end()->set_reason(reason);
    message.header.mutable_end()->set_detail("because");
    reply(std::move(message));
  }

  zmq::context_t context_;
  zmq::socket_t router_;
  std::filesystem::path directory_;
  std::string endpoint_, peer_;
  Scene scene_;
  std::vector<std::uint32_t> own_;  // bodies of the participant; empty: all
  std::atomic<bool> stop_{false};
  std::future<End> participant_;
};

TEST_F(ParticipantTest, streams_prescribed_motion_with_two_batches_on_their_way) {
  add_body().mutable_prescribed()->mutable_constant()->add_velocity(2);
  start();
  welcome(200);
  std::uint64_t next = 1;
  std::vector<Kinematics> unanswered;
  const protocol::StepClock clock(kInterval, 10, 200);
  while (next <= 200) {
    const Message message = receive();
    const Kinematics& batch = message.header.kinematics();
    ASSERT_EQ(batch.first_step(), next);
    ASSERT_EQ(batch.count(), std::min<std::uint64_t>(64, 201 - next));
    EXPECT_EQ(message.header.run_id(), "run");
    EXPECT_EQ(message.header.session_token(), kToken);
    EXPECT_EQ(message.header.sequence(), next / 64 + 1);
    const auto rows = message.array<double>("kinematics");
    for (std::uint32_t i = 0; i < batch.count(); ++i) {
      EXPECT_NEAR(rows[19 * i], 5 + 2 * protocol::seconds(clock.time(next + i)), 1e-14);
      EXPECT_NEAR(rows[19 * i + 7], 2, 1e-9);
    }
    next += batch.count();
    unanswered.push_back(batch);
    if (unanswered.size() == 2) {
      const auto third = protocol::receive_within(router_, 50);
      EXPECT_FALSE(third && third->message.header.has_kinematics()) << "a third batch before an answer";
      answer(unanswered.front());
      unanswered.erase(unanswered.begin());
    }
  }
  for (const Kinematics& batch : unanswered) answer(batch);
  end(End::FINISHED);
  EXPECT_EQ(participant_.get().reason(), End::FINISHED);
}

TEST_F(ParticipantTest, a_free_body_waits_for_the_wrench_of_every_step) {
  add_body().set_mass(2);
  start();
  welcome(30);
  const double dt = 1e-4, up = 2 * (9.81 + 3);  // leaves an acceleration of 3 m/s^2 after the first half kick
  double velocity = -9.81 * dt / 2;
  for (std::uint64_t step = 1; step <= 30; ++step) {
    const Message message = receive();
    EXPECT_EQ(message.header.kinematics().first_step(), step);
    ASSERT_EQ(message.header.kinematics().count(), 1u);
    EXPECT_NEAR(message.array<double>("kinematics")[8], velocity, 1e-12);
    answer(message.header.kinematics(), {0, up, 0, 0, 0, 0});
    velocity += 3 * dt;
  }
  end(End::UNSTABLE);
  EXPECT_EQ(participant_.get().reason(), End::UNSTABLE);
}

// The first is free and somebody else's: what is left is streamed.
TEST_F(ParticipantTest, moves_the_bodies_that_it_is_told_to) {
  add_body().set_mass(2);
  scene_.mutable_body(0)->set_owner("crane");
  add_body().mutable_prescribed()->mutable_constant()->add_velocity(2);
  own_ = {1};
  start();
  welcome(64);
  const Message message = receive();
  EXPECT_EQ(message.header.kinematics().count(), 64u);
  EXPECT_EQ(message.shape("kinematics"), (std::vector<std::uint64_t>{64, 1, 19}));
  EXPECT_NEAR(message.array<double>("kinematics")[7], 2, 1e-9);
  answer(message.header.kinematics());
  end(End::FINISHED);
  EXPECT_EQ(participant_.get().reason(), End::FINISHED);
}

TEST_F(ParticipantTest, an_end_may_come_at_any_time) {
  add_body().set_mass(2);
  start();
  welcome(30);
  receive();
  end(End::INTERRUPTED);
  const End got = participant_.get();
  EXPECT_EQ(got.reason(), End::INTERRUPTED);
  EXPECT_EQ(got.detail(), "because");
}

TEST_F(ParticipantTest, a_refusal_gives_its_reason) {
  start();
  receive();
  Message message;
  message.header.mutable_refusal()->set_code(Refusal::ROLE_TAKEN);
  message.header.mutable_refusal()->set_reason("somebody else is RIGID");
  reply(std::move(message));
  EXPECT_THAT([&] { participant_.get(); }, ThrowsMessage<Refused>("somebody else is RIGID"));
}

TEST_F(ParticipantTest, notices_that_the_server_is_gone) {
  add_body().set_mass(2);
  start();
  welcome(30);
  receive();
  router_.close();
  EXPECT_THAT([&] { participant_.get(); },
              ThrowsMessage<protocol::PeerLost>(HasSubstr("closed the connection")));
}

TEST_F(ParticipantTest, answers_a_request_to_stop) {
  add_body().set_mass(2);
  start();
  welcome(30);
  receive();
  stop_ = true;
  EXPECT_THROW(participant_.get(), Interrupted);
}

TEST_F(ParticipantTest, refuses_an_answer_to_another_step) {
  add_body().set_mass(2);
  start();
  welcome(30);
  Kinematics asked = receive().header.kinematics();
  asked.set_first_step(7);
  answer(asked);
  EXPECT_THAT(
      [&] { participant_.get(); },
      ThrowsMessage<protocol::ProtocolError>(HasSubstr("1 steps from step 7 came, 1 from step 1 were due")));
}

TEST_F(ParticipantTest, refuses_a_wrench_that_is_not_finite) {
  add_body().set_mass(2);
  start();
  welcome(30);
  answer(receive().header.kinematics(), {NAN, 0, 0, 0, 0, 0});
  EXPECT_THAT([&] { participant_.get(); }, ThrowsMessage<std::invalid_argument>(HasSubstr("not finite")));
}

TEST_F(ParticipantTest, a_scene_that_cannot_be_moved_is_bad_input) {
  add_body().mutable_prescribed()->mutable_expression()->set_x("sin(");
  start();
  welcome(30);
  EXPECT_THAT([&] { participant_.get(); },
              ThrowsMessage<protocol::InputError>(HasSubstr("body 'body1': formula 'sin('")));
}

TEST(Participant, refuses_an_endpoint_that_is_none) {
  const std::atomic<bool> stop{false};
  EXPECT_THROW(take_part_as_rigid("nonsense", {}, stop), protocol::InputError);
}

}  // namespace
}  // namespace sluice::clients
