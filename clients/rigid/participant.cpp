#include "clients/rigid/participant.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <deque>

#include "clients/rigid/convert.hpp"
#include "clients/rigid/own_part.hpp"
#include "clients/rigid/participant_link.hpp"
#include "clients/rigid/window.hpp"
#include "protocol/build_id.hpp"
#include "protocol/scene_check.hpp"
#include "protocol/sim_time.hpp"

namespace sluice::clients {
namespace {

constexpr std::size_t kRow = 19;        // doubles of a body's kinematics
constexpr std::size_t kWrenchRow = 6;   // doubles of a body's wrench
constexpr std::size_t kLedgerRow = 29;  // doubles of a body's ledger
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

// Of every step, from an array [count, bodies, 6], or [bodies, 6] when count is 1.
std::vector<Wrenches> read_wrenches(const protocol::Message& message, std::size_t count, std::size_t bodies) {
  const auto values = message.array<double>("wrenches");
  if (values.size() != count * bodies * kWrenchRow)
    throw protocol::ProtocolError(
        fmt::format("wrenches of {} values for {} steps of {} bodies, {} are needed", values.size(), count,
                    bodies, count * bodies * kWrenchRow));
  std::vector<Wrenches> steps(count, Wrenches(bodies));
  const double* row = values.data();
  for (Wrenches& wrenches : steps) {
    for (rigid::Wrench& wrench : wrenches) {
      wrench.force = Eigen::Map<const Eigen::Vector3d>(row);
      wrench.moment = Eigen::Map<const Eigen::Vector3d>(row + 3);
      row += kWrenchRow;
    }
  }
  return steps;
}

rigid::World make_world(const Scene& scene) {
  try {
    return rigid::World(to_world(protocol::with_defaults(scene)));
  } catch (const std::invalid_argument& error) {
    throw protocol::InputError(fmt::format("scene '{}': {}", scene.name(), error.what()));
  }
}

Eigen::Vector3d gravity_of(const Scene& scene) {
  return to_vector(protocol::with_defaults(scene).gravity());
}

class Participant {
 public:
  Participant(ParticipantLink& link, const protocol::Message& welcome)
      : link_(link),
        world_(make_world(own_part(welcome.header.welcome()))),
        clock_(welcome.header.welcome().interval_ns(), welcome.header.welcome().steps_per_interval(),
               welcome.header.welcome().steps()),
        coupling_(welcome.header.welcome().coupling()),
        window_(world_, coupling_, gravity_of(welcome.header.welcome().scene()),
                own_indicators(welcome.header.welcome()), read_wrenches(welcome, 1, world_.size()).front()),
        done_(welcome.header.welcome().done()),
        wants_state_(welcome.header.welcome().wants_state()) {
    if (done_ > 0) go_on_from(welcome);
  }

  End run() {
    spdlog::info("{} {}, {} steps, {}", world_.size(), world_.size() == 1 ? "body" : "bodies", clock_.steps(),
                 exchange_text());
    if (world_.has_free_bodies())
      exchange();
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

  // Prescribed bodies stand where their motion is; free ones where they were.
  void go_on_from(const protocol::Message& welcome) {
    if (!world_.has_free_bodies()) {
      (void)world_.predict(protocol::seconds(clock_.time(done_)), duration(done_));
      return;
    }
    const std::string& its = welcome.header.welcome().state_build();
    if (its != protocol::build_id())
      throw protocol::InputError(fmt::format(
          "the state of the bodies is of another build of sluice-rigid ({}; this one is {}), where "
          "they would not go on to the last bit; resume with that one",
          its, protocol::build_id()));
    try {
      window_.read_state(welcome.array<double>("state"));
    } catch (const std::invalid_argument& error) {
      throw protocol::ProtocolError(error.what());
    }
  }

  void give_state(std::uint64_t step) {
    const std::vector<double> state = window_.write_state();
    protocol::Message message;
    message.header.set_step(step);
    message.header.mutable_state()->set_step(step);
    message.header.mutable_state()->set_build(protocol::build_id());
    message.add_array<double>("state", state, {state.size()});
    link_.send(std::move(message));
  }

  [[nodiscard]] std::string exchange_text() const {
    if (!world_.has_free_bodies()) return "all prescribed, streamed ahead";
    return fmt::format("exchanges of {} step(s), {}", most_steps(),
                       is_iterated() ? "each repeated until motion and force agree" : "each once");
  }

  [[nodiscard]] bool is_iterated() const { return coupling_.scheme() == IMPLICIT; }
  // Of a server that says nothing, one.
  [[nodiscard]] std::uint64_t most_steps() const {
    return std::max<std::uint64_t>(1, coupling_.steps_per_exchange());
  }

  void exchange() {
    for (std::uint64_t first = done_ + 1; first <= clock_.steps();) {
      const std::uint64_t last = clock_.exchange_end(first, most_steps());
      if (!exchange({first, static_cast<std::uint32_t>(last - first + 1)})) break;
      if (clock_.is_output(last)) {
        // Whether anybody keeps the state or not: what follows must be the same.
        world_.renew_contact();
        if (wants_state_) give_state(last);
      }
      first = last + 1;
    }
    if (is_iterated() && exchanges_ > 0)
      spdlog::info("{:.2f} iterations an exchange, {} given up, largest residual {:.2g}",
                   static_cast<double>(iterations_) / static_cast<double>(exchanges_), given_up_,
                   largest_residual_);
  }

  // False once the run has ended.
  bool exchange(const Batch& batch) {
    std::vector<Window::Step> steps;
    for (std::uint64_t step = batch.first_step; step < batch.first_step + batch.count; ++step)
      steps.push_back({protocol::seconds(clock_.time(step)), duration(step)});
    window_.begin(std::move(steps));
    note_ledger();
    while (true) {
      std::vector<double> rows;
      for (const Window::Motion& motion : window_.predict())
        for (const rigid::Kinematics& body : motion) append(rows, body);
      send(batch, rows, static_cast<std::uint32_t>(window_.iterations() - 1));
      const auto answer = next_answer();
      if (!answer) return false;
      if (window_.accept(read_wrenches(*answer, batch.count, world_.size()))) break;
    }
    if (is_iterated()) say_accepted(batch);
    return true;
  }

  void note_ledger() {
    ledger_.clear();
    const auto add = [this](const rigid::Wrench& pair) {
      ledger_.insert(ledger_.end(), pair.force.begin(), pair.force.end());
      ledger_.insert(ledger_.end(), pair.moment.begin(), pair.moment.end());
    };
    const auto add_given = [&](const rigid::Given& given) {
      add(given.impulse);
      ledger_.push_back(given.work);
    };
    for (std::size_t b = 0; b < world_.size(); ++b) {
      const rigid::Account account = world_.is_free(b) ? world_.account(b) : rigid::Account{};
      add(account.momentum);
      add_given(account.contact);
      ledger_.insert(ledger_.end(), {account.kinetic_energy, account.mass});
      add_given(account.joints);
      add_given(account.drive);
    }
  }

  void say_accepted(const Batch& batch) {
    ++exchanges_;
    iterations_ += static_cast<std::uint64_t>(window_.iterations());
    if (window_.residual() > coupling_.tolerance()) ++given_up_;
    largest_residual_ = std::max(largest_residual_, window_.residual());
    protocol::Message message;
    message.header.set_step(batch.first_step + batch.count - 1);
    Accepted& accepted = *message.header.mutable_accepted();
    accepted.set_first_step(batch.first_step);
    accepted.set_count(batch.count);
    accepted.set_iterations(static_cast<std::uint32_t>(window_.iterations()));
    accepted.set_residual(window_.residual());
    link_.send(std::move(message));
  }

  void stream() {
    for (std::uint64_t first = done_ + 1; first <= clock_.steps() && !end_; first += kBatch) {
      stream(
          {first, static_cast<std::uint32_t>(std::min<std::uint64_t>(kBatch, clock_.steps() - first + 1))});
      while (unanswered_.size() >= kUnanswered && next_answer()) {
      }
    }
  }

  void stream(const Batch& batch) {
    std::vector<double> rows;
    rows.reserve(batch.count * world_.size() * kRow);
    for (std::uint64_t step = batch.first_step; step < batch.first_step + batch.count; ++step)
      for (const rigid::Kinematics& body :
           world_.predict(protocol::seconds(clock_.time(step)), duration(step)))
        append(rows, body);
    send(batch, rows, 0);
  }

  void send(const Batch& batch, const std::vector<double>& rows, std::uint32_t iteration) {
    const std::uint64_t last = batch.first_step + batch.count - 1;
    protocol::Message message;
    message.header.set_sequence(++sequence_);
    message.header.set_step(last);
    message.header.set_time_ns(clock_.time(last));
    message.header.mutable_kinematics()->set_first_step(batch.first_step);
    message.header.mutable_kinematics()->set_count(batch.count);
    message.header.mutable_kinematics()->set_iteration(iteration);
    message.add_array<double>("kinematics", rows, {batch.count, world_.size(), kRow});
    if (world_.has_free_bodies()) message.add_array<double>("ledger", ledger_, {world_.size(), kLedgerRow});
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
  Coupling coupling_;
  Window window_;
  std::uint64_t done_;  // steps, before this process took part
  bool wants_state_;
  std::vector<double> ledger_;  // at the beginning of the exchange
  std::uint64_t exchanges_ = 0, iterations_ = 0, given_up_ = 0;
  double largest_residual_ = 0;
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
