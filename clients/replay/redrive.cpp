#include "clients/replay/redrive.hpp"

#include <fmt/format.h>
#include <google/protobuf/text_format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <csignal>
#include <deque>
#include <fstream>

#include "clients/record/connection.hpp"
#include "clients/replay/comparison.hpp"
#include "clients/sluice/endpoints.hpp"
#include "clients/sluice/process.hpp"
#include "clients/sluice/siblings.hpp"
#include "protocol/body_kind.hpp"
#include "protocol/framing.hpp"
#include "protocol/sim_time.hpp"

namespace sluice::clients {
namespace {

using protocol::Message;
using std::chrono::milliseconds;

constexpr milliseconds kSlice{100};
constexpr std::uint64_t kSteps = 64;        // in one message of prescribed kinematics
constexpr std::size_t kMostUnanswered = 2;  // messages

std::filesystem::path write_scene(const Scene& scene, const std::string& endpoint) {
  const std::filesystem::path socket(endpoint.substr(std::string("ipc://").size()));
  auto path = socket.parent_path() / "recorded.scene";
  std::string text;
  google::protobuf::TextFormat::PrintToString(scene, &text);
  std::ofstream(path) << text;
  return path;
}

// Sends the recorded kinematics of an owner's bodies, as far ahead as the protocol allows.
class RecordedRigid {
 public:
  RecordedRigid(const Reader& recording, zmq::context_t& context, const protocol::Endpoint& endpoint,
                const std::string& owner)
      : recording_(recording),
        connection_(context, endpoint, std::nullopt),
        bodies_(protocol::bodies_of(recording.scene(), owner)),
        lock_step_(owner.empty() && protocol::is_any_body_ever_free(recording.scene())),
        is_iterated_(lock_step_ && recording.welcome().coupling().scheme() == IMPLICIT),
        clock_(recording.welcome().interval_ns(), recording.welcome().steps_per_interval(),
               recording.welcome().steps()),
        ahead_(lock_step_ ? 1 : kMostUnanswered) {
    connection_.greet(RIGID, "sluice-replay", owner);
  }

  [[nodiscard]] zmq::pollitem_t poll_item() { return connection_.poll_item(); }
  void watch() { connection_.watch(); }
  [[nodiscard]] bool all_answered() const { return sent_ == recording_.exchanges() && unanswered_ == 0; }

  void turn() {
    while (auto message = connection_.receive())
      if (message->header.has_wrenches()) take_answer();
    while (connection_.welcomed() && unanswered_ < ahead_ && sent_ < recording_.exchanges()) send_next();
  }

 private:
  [[nodiscard]] std::uint64_t batch_steps() const {
    if (!lock_step_) return kSteps;
    const std::uint64_t most =
        std::max<std::uint64_t>(1, recording_.welcome().coupling().steps_per_exchange());
    return clock_.exchange_end(sent_ + 1, most) - sent_;
  }

  // The first `steps` steps of an array [steps, bodies, width] of the log, of the bodies moved here.
  [[nodiscard]] std::vector<double> own_rows(const Message& log, const std::string& name,
                                             std::uint64_t steps) const {
    const std::vector<std::uint64_t> shape = log.shape(name);
    const std::span<const double> all = log.array<double>(name);
    std::vector<double> rows;
    for (std::uint64_t step = 0; step < steps; ++step)
      for (const int b : bodies_) {
        const auto row = all.subspan((step * shape[1] + static_cast<std::uint64_t>(b)) * shape[2], shape[2]);
        rows.insert(rows.end(), row.begin(), row.end());
      }
    return rows;
  }

  void add(Message& message, const std::string& name, const Message& log, std::uint64_t steps) const {
    const std::vector<double> rows = own_rows(log, name, steps);
    std::vector<std::uint64_t> shape{steps, bodies_.size(), log.shape(name)[2]};
    if (name == "ledger") shape.erase(shape.begin());
    message.add_array<double>(name, rows, shape);
  }

  // The motion recorded is that of the last iteration.
  void take_answer() {
    --unanswered_;
    if (!is_iterated_) return;
    const auto coupling = recording_.exchange_log(sent_, 1).array<double>("coupling");
    Message message;
    message.header.set_step(sent_);
    Accepted& accepted = *message.header.mutable_accepted();
    accepted.set_first_step(sent_ - last_count_ + 1);
    accepted.set_count(last_count_);
    accepted.set_iterations(static_cast<std::uint32_t>(coupling[0]));
    accepted.set_residual(coupling[1]);
    connection_.send(std::move(message));
  }

  void send_next() {
    // Cut where the recording ends.
    const std::uint64_t left = recording_.exchanges() - sent_;
    const auto count = static_cast<std::uint32_t>(std::min(batch_steps(), left));
    const Message log = recording_.exchange_log(sent_ + 1, count);
    Message message;
    message.header.set_step(log.header.step());
    message.header.set_time_ns(log.header.time_ns());
    message.header.mutable_kinematics()->set_first_step(sent_ + 1);
    message.header.mutable_kinematics()->set_count(count);
    add(message, "kinematics", log, count);
    if (lock_step_) add(message, "ledger", log, 1);
    connection_.send(std::move(message));
    sent_ += count;
    last_count_ = count;
    ++unanswered_;
  }

  const Reader& recording_;
  Connection connection_;
  std::vector<int> bodies_;
  bool lock_step_, is_iterated_;
  protocol::StepClock clock_;
  std::uint32_t last_count_ = 0;
  std::size_t ahead_;
  std::uint64_t sent_ = 0;
  std::size_t unanswered_ = 0;
};

class Redrive {
 public:
  Redrive(const Reader& recording, int threads, const std::atomic<bool>& stop)
      : recording_(recording),
        stop_(stop),
        scene_file_(write_scene(recording.scene(), endpoint_.text())),
        server_(sibling("sluice-server"), arguments(threads)),
        recorder_(std::in_place, context_, protocol::Endpoint::parse(endpoint_.text()), std::nullopt),
        stream_(protocol::make_socket(context_, zmq::socket_type::pull)) {}

  // The connections first: the server would wait for a recorder that is there.
  ~Redrive() {
    rigid_.clear();
    recorder_.reset();
    server_.signal(SIGTERM);
    server_.wait();
    std::error_code ignored;
    std::filesystem::remove(scene_file_, ignored);
  }

  RedriveResult run() {
    recorder_->greet(RECORDER, "sluice-replay");
    for (const std::string& owner : protocol::owners(recording_.scene()))
      rigid_.emplace_back(recording_, context_, protocol::Endpoint::parse(endpoint_.text()), owner);
    while (difference_.empty() && !done()) turn();
    return {difference_.empty(), difference_.empty() ? "identical" : difference_};
  }

 private:
  [[nodiscard]] std::vector<std::string> arguments(int threads) const {
    const auto recorded = std::max<int>(static_cast<int>(recording_.welcome().build().threads()), 1);
    return {"--scene",          scene_file_.string(), "--listen",
            endpoint_.text(),   "--threads",          std::to_string(threads > 0 ? threads : recorded),
            "--expect-recorder"};
  }

  [[nodiscard]] bool done() const { return frames_ == recording_.frames() && steps_ >= last_compared_step(); }
  [[nodiscard]] std::uint64_t last_compared_step() const {
    return recording_.scene().body_size() > 0 ? recording_.exchanges() : 0;
  }

  void turn() {
    if (stop_) throw std::runtime_error("interrupted");
    std::vector<zmq::pollitem_t> items = {{stream_.handle(), 0, ZMQ_POLLIN, 0}, recorder_->poll_item()};
    for (RecordedRigid& rigid : rigid_) items.push_back(rigid.poll_item());
    if (server_.output() >= 0) items.push_back({nullptr, server_.output(), ZMQ_POLLIN, 0});
    wait_for_any(items, kSlice);
    server_.read_output();
    for (RecordedRigid& rigid : rigid_) rigid.turn();
    if (auto message = recorder_->receive()) compare_welcome(*message);
    while (difference_.empty() && !done() && take_next()) {
    }
    if (difference_.empty() && !done()) {
      stop_server_after_last_step();
      watch();
    }
  }

  // A run that was stopped between two frames: the server logs the last exchanges only when it ends.
  void stop_server_after_last_step() {
    const bool all_answered =
        std::ranges::all_of(rigid_, [](const RecordedRigid& rigid) { return rigid.all_answered(); });
    if (stopped_ || rigid_.empty() || !all_answered || frames_ < recording_.frames()) return;
    stopped_ = true;
    server_.signal(SIGTERM);
  }

  void watch() {
    if (server_.exit_code()) throw std::runtime_error("the server ended early: " + last_words());
    recorder_->watch();
    for (RecordedRigid& rigid : rigid_) rigid.watch();
  }

  [[nodiscard]] std::string last_words() {
    server_.read_output();
    return server_.last_lines().empty() ? "it said nothing" : server_.last_lines().back();
  }

  void compare_welcome(const Message& message) {
    if (!message.header.has_welcome()) return;
    const Welcome& now = message.header.welcome();
    const Welcome& before = recording_.welcome();
    if (now.interval_ns() != before.interval_ns() || now.steps_per_interval() != before.steps_per_interval())
      difference_ = fmt::format("steps: recorded {} in {} ns, now {} in {} ns", before.steps_per_interval(),
                                before.interval_ns(), now.steps_per_interval(), now.interval_ns());
    else if (now.fluid_particles() != before.fluid_particles())
      difference_ =
          fmt::format("particles: recorded {}, now {}", before.fluid_particles(), now.fluid_particles());
    warn_of_build(before.build(), now.build());
    stream_.connect(protocol::Endpoint::parse(endpoint_.text()).record);
  }

  static void warn_of_build(const Build& before, const Build& now) {
    const auto warn = [](const char* what, const std::string& was, const std::string& is) {
      if (was != is) spdlog::warn("recorded with {} {}, this is {}: bits may differ", what, was, is);
    };
    warn("version", before.version(), now.version());
    warn("compiler", before.compiler(), now.compiler());
    warn("processor", before.processor(), now.processor());
  }

  // One message of the server's record; its order is that of time.
  bool take_next() {
    auto received = protocol::receive(stream_);
    if (!received) return false;
    recorder_->hear();
    const Message& message = received->message;
    if (message.header.has_exchange_log()) compare_exchanges(message);
    if (message.header.has_frame()) compare_frame(message);
    if (message.header.has_end() && !done())
      difference_ = fmt::format("end: recorded {} frames and {} steps, now {} frames and {} steps ({})",
                                recording_.frames(), last_compared_step(), frames_, steps_,
                                message.header.end().detail());
    Message acknowledgement;
    acknowledgement.header.mutable_acknowledgement()->set_sequence(message.header.sequence());
    recorder_->send(std::move(acknowledgement));
    return true;
  }

  void compare_exchanges(const Message& message) {
    const ExchangeLog& log = message.header.exchange_log();
    const Message recorded = recording_.exchange_log(log.first_step(), log.count());
    if (auto found = first_difference(recorded, message, recording_.scene())) difference_ = *found;
    steps_ = log.first_step() + log.count() - 1;
  }

  void compare_frame(const Message& message) {
    const std::uint64_t index = message.header.frame().index();
    if (index >= recording_.frames()) return;
    const Message recorded = recording_.frame(index);
    if (auto found = first_difference(recorded, message, recording_.scene()))
      difference_ = fmt::format("frame {} (t = {:g} s): {}", index,
                                1e-9 * static_cast<double>(message.header.time_ns()), *found);
    frames_ = index + 1;
  }

  const Reader& recording_;
  const std::atomic<bool>& stop_;
  PrivateEndpoint endpoint_;
  std::filesystem::path scene_file_;
  Child server_;
  zmq::context_t context_;
  std::optional<Connection> recorder_;
  zmq::socket_t stream_;
  std::deque<RecordedRigid> rigid_;
  bool stopped_ = false;
  std::uint64_t frames_ = 0, steps_ = 0;
  std::string difference_;
};

}  // namespace

RedriveResult redrive(const Reader& recording, int threads, const std::atomic<bool>& stop) {
  if (recording.frames() == 0)
    throw protocol::InputError(recording.path().string() + " holds no frame to compare with");
  return Redrive(recording, threads, stop).run();
}

}  // namespace sluice::clients
