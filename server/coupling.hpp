#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "server/checkpoints.hpp"
#include "server/exchange_logger.hpp"
#include "server/owners.hpp"
#include "server/progress.hpp"
#include "server/publisher.hpp"
#include "server/record_stream.hpp"
#include "server/session.hpp"
#include "server/simulation.hpp"
#include "server/sockets.hpp"
#include "server/stop.hpp"

namespace sluice::server {

struct Options {
  bool expect_recorder = false;
  std::chrono::milliseconds deadline{4000};            // for the kinematics of a step
  std::chrono::milliseconds start_deadline{30000};     // for everyone to join
  std::chrono::milliseconds recorder_deadline{30000};  // for an acknowledgement the run waits for
  const std::atomic<bool>* interrupted = nullptr;      // set by a signal: end in good order
  CheckpointOptions checkpoint{};
};

// "the recorder did not join within 30 s"
std::string late(std::string_view what, std::chrono::milliseconds deadline);

// The run's side of every conversation: poses in, wrenches out, frames to the recorder and the watchers.
// Called from the thread of the simulation; all messages are dealt with inside these calls. Any of them may
// throw Stop.
class Coupling {
 public:
  Coupling(const Simulation& simulation, Sockets& sockets, const Options& options);

  void wait_for_participants();

  // The bodies' poses over a step; waits for who moves them. Empty when the scene has no bodies.
  std::span<const fluid::Kinematics> kinematics(std::uint64_t step);
  // The last step that may be taken before the rigid process has to be heard again; waits for it.
  std::uint64_t exchange_end(std::uint64_t first);
  // The step is done: logs the exchange, with the bodies' stability, and answers who moves them with the
  // solver's wrenches.
  void answer(std::uint64_t step, std::span<const double> indicators);
  // Whether the steps answered since exchange_end are to be done again, from the state before them; waits for
  // the rigid process where exchanges are iterated. When not, they are logged.
  bool repeats();
  // Of an iterated exchange that is not done again, what the rigid process said of it.
  [[nodiscard]] const Accepted& accepted() const { return accepted_; }
  // Hands the state to the recorder and the watchers; waits while the recorder is too far behind.
  void output(std::uint64_t step);
  // Keeps the state after an output step, and writes it to disk when that is due and the recorder has all up
  // to there; waits for the rigid process to give its part.
  void checkpoint(std::uint64_t step);
  // Looks after messages and publishes the status. Costs next to nothing when it was called just before.
  void poll();

  // Tells everyone; waits until the recorder has everything. Does not throw Stop: when the recorder is lost
  // here, that becomes the outcome of a run that was fine.
  void end(Outcome& outcome);

 private:
  // Serves messages until done(); throws fail() when that takes longer than the deadline.
  void wait_until(const std::function<bool()>& done, std::chrono::milliseconds deadline,
                  const std::function<Stop()>& fail);
  void wait_for_kinematics(std::uint64_t step);
  void service(std::chrono::milliseconds timeout);
  void dispatch(const Session::Inbound& inbound);
  // Notes a message that is made for the recorder or for watchers.
  void count(const protocol::Message& message);
  void record(protocol::Message message);
  void record_log();
  void drain_recorder();
  void take_state(const protocol::Message& message);
  // Whether checkpoints are wanted and can be written: who moves bodies with an owner does not give its
  // state.
  [[nodiscard]] bool has_checkpoints() const { return checkpoints_.wanted() && !owners_.has_others(); }
  void write_checkpoint();
  void write_last_checkpoint(Outcome& outcome);
  void bring_to_recorder(Outcome& outcome, const std::function<void()>& send);
  void publish_status();
  void send(std::vector<Owners::Reply> replies);
  [[nodiscard]] Owners::Probes probes() const;
  // Adds run id, version and time to a message that does not go through the session.
  void stamp(Header& header) const;

  const Simulation& simulation_;
  Sockets& sockets_;
  Options options_;
  std::size_t bodies_;
  bool lock_step_, is_iterated_;
  Owners owners_;
  Session session_;
  Accepted accepted_;
  ExchangeLogger log_;
  RecordStream recorder_;
  Checkpoints checkpoints_;
  std::uint64_t kept_after_ = 0;  // message to the recorder
  // What the rigid process gave of its state, and whether it does.
  struct RigidState {
    std::uint64_t step = 0;
    std::string build;
    std::vector<double> numbers;
  };
  RigidState rigid_state_;
  bool gives_state_ = false;
  Publisher publisher_;
  Progress progress_;
  std::chrono::steady_clock::time_point polled_;
  std::vector<double> indicators_;  // of the bodies, at the last step
  std::uint64_t step_ = 0;          // done
  Outcome outcome_;                 // what of it is counted on the way
  bool ending_ = false;
};

}  // namespace sluice::server
