#include "clients/rigid/participant.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <deque>

#include "clients/rigid/convert.hpp"
#include "clients/rigid/participant_link.hpp"
#include "protocol/scene_check.hpp"
#include "protocol/sim_time.hpp"

namespace sluice::clients {
namespace {

constexpr std::size_t kRow = 19;        // doubles of a body's kinematics
constexpr std::size_t kWrenchRow = 6;   // doubles of a body's wrench
constexpr std::uint32_t kBatch = 64;    // steps of a message when streaming
constexpr std::size_t kUnanswered = 2;  // batches on their way when streaming

using Wrenches = std::vector<rigid::Wrench>;

void append(std::vector<double>& rows, const rigid::Kinematics& k) {
  const auto vector = [&](const Eigen::Vector3d& v) { rows.insert(rows.end(), v.begin(), v.end()); };
  const Eigen::Quaterniond& q = k.orientation;
  vector(k.position);
  rows.insert(rows.end(), {q.w(), q.x(), q.y(), q.z()});
  vector(k.velocity);
  vector(k.angular_velocity);
  vector(k.acceleration);
  vector(k.angular_acceleration);
}

// The last step's wrenches of an array [count, bodies, 6], or [bodies, 6] when count is 1.
Wrenches last_wrenches(const protocol::Message& message, std::size_t count, std::size_t bodies) {
  const auto values = message.array<double>("wrenches");
  if (values.size() != count * bodies * kWrenchRow)
    throw protocol::ProtocolError(
        fmt::format("wrenches of {} values for {} steps of {} bodies, {} are needed", values.size(), count,
                    bodies, count * bodies * kWrenchRow));
  Wrenches wrenches(bodies);
  const double* row = values.data() + (count - 1) * bodies * kWrenchRow;
  for (rigid::Wrench& wrench : wrenches) {
    wrench.force = Eigen::Map<const Eigen::Vector3d>(row);
    wrench.moment = Eigen::Map<const Eigen::Vector3d>(row + 3);
    row += kWrenchRow;
  }
  return wrenches;
}

rigid::World make_world(const Scene& scene) {
  try {
    return rigid::World(to_world(protocol::with_defaults(scene)));
  } catch (const std::invalid_argument& error) {
    throw protocol::InputError(fmt::format("scene '{}': {}", scene.name(), error.what()));
  }
}

class Participant {
 public:
  Participant(ParticipantLink& link, const protocol::Message& welcome)
      : link_(link),
        world_(make_world(welcome.header.welcome().scene())),
        clock_(welcome.header.welcome().interval_ns(), welcome.header.welcome().steps_per_interval(),
               welcome.header.welcome().steps()) {
    world_.start(last_wrenches(welcome, 1, world_.size()));
  }

  End run() {
    spdlog::info("{} {}, {} steps, {}", world_.size(), world_.size() == 1 ? "body" : "bodies", clock_.steps(),
                 world_.has_free_bodies() ? "one exchange a step" : "all prescribed, streamed ahead");
    if (world_.has_free_bodies())
      exchange_step_by_step();
    else
      stream();
    while (!end_) (void)next_answer();
    return *end_;
  }

 private:
  struct Batch {
    std::uint64_t first_step;
    std::uint32_t count;
  };

  void exchange_step_by_step() {
    for (std::uint64_t step = 1; step <= clock_.steps(); ++step) {
      send({step, 1});
      const auto answer = next_answer();
      if (!answer) return;
      world_.correct(duration(step), last_wrenches(*answer, 1, world_.size()));
    }
  }

  void stream() {
    for (std::uint64_t first = 1; first <= clock_.steps() && !end_; first += kBatch) {
      send({first, static_cast<std::uint32_t>(std::min<std::uint64_t>(kBatch, clock_.steps() - first + 1))});
      while (unanswered_.size() >= kUnanswered && next_answer()) {
      }
    }
  }

  void send(const Batch& batch) {
    std::vector<double> rows;
    rows.reserve(batch.count * world_.size() * kRow);
    const std::uint64_t last = batch.first_step + batch.count - 1;
    for (std::uint64_t step = batch.first_step; step <= last; ++step)
      for (const rigid::Kinematics& body :
           world_.predict(protocol::seconds(clock_.time(step)), duration(step)))
        append(rows, body);

    protocol::Message message;
    message.header.set_sequence(++sequence_);
    message.header.set_step(last);
    message.header.set_time_ns(clock_.time(last));
    message.header.mutable_kinematics()->set_first_step(batch.first_step);
    message.header.mutable_kinematics()->set_count(batch.count);
    message.add_array<double>("kinematics", rows, {batch.count, world_.size(), kRow});
    link_.send(std::move(message));
    unanswered_.push_back(batch);
  }

  // The answer to the oldest batch, or nothing once the run has ended.
  std::optional<protocol::Message> next_answer() {
    protocol::Message message = link_.wait();
    if (message.header.has_end()) {
      end_ = message.header.end();
      return std::nullopt;
    }
    check_answer(message.header);
    unanswered_.pop_front();
    return message;
  }

  void check_answer(const Header& header) const {
    if (!header.has_wrenches() || unanswered_.empty())
      throw protocol::ProtocolError(fmt::format("content {} from the server where {} was due",
                                                static_cast<int>(header.content_case()),
                                                unanswered_.empty() ? "the end" : "wrenches"));
    const Batch& due = unanswered_.front();
    const sluice::Wrenches& came = header.wrenches();
    if (came.first_step() != due.first_step || came.count() != due.count)
      throw protocol::ProtocolError(
          fmt::format("wrenches of {} steps from step {} came, {} from step {} were due", came.count(),
                      came.first_step(), due.count, due.first_step));
  }

  [[nodiscard]] double duration(std::uint64_t step) const { return protocol::seconds(clock_.duration(step)); }

  ParticipantLink& link_;
  rigid::World world_;
  protocol::StepClock clock_;
  std::uint64_t sequence_ = 0;
  std::deque<Batch> unanswered_;
  std::optional<End> end_;
};

}  // namespace

End take_part_as_rigid(const std::string& endpoint, const std::optional<protocol::ClientKeys>& keys,
                       const std::atomic<bool>& stop) {
  zmq::context_t context;
  ParticipantLink link(context, endpoint, keys, stop);
  const protocol::Message welcome = link.greet(RIGID, "sluice-rigid");
  return Participant(link, welcome).run();
}

}  // namespace sluice::clients
