#pragma once

#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "messages.pb.h"
#include "protocol/message.hpp"
#include "scene.pb.h"
#include "server/kinematics_rows.hpp"

namespace sluice::server {

// The kinematics that one who moves bodies sent for steps to come, and the replies it is owed. Knows no
// socket.
//
// Sequences are contiguous from 1, steps from the first that is not done. In lock-step, when a body is free,
// every message is one exchange, as the next needs its answer; otherwise messages hold up to kMostSteps steps
// and up to kMostUnanswered of them wait here. Where exchanges are iterated the rigid process sends the steps
// of one again, or accepts it, before it goes on.
class Exchange {
 public:
  static constexpr std::uint32_t kMostSteps = 256;
  static constexpr std::size_t kMostUnanswered = 2;

  struct Terms {
    bool lock_step = false;                // a body is free
    std::uint64_t steps_per_exchange = 1;  // at most, in lock-step; none goes beyond an output
    std::uint64_t steps_per_output = 1;
    bool is_iterated = false;
    std::uint64_t done = 0;  // steps before the first that comes
  };

  Exchange(std::size_t bodies, std::uint64_t steps, const Terms& terms);

  // Takes in a message with Kinematics. The sequence of a message that is answered already returns the reply
  // that was given; of one that waits for its answer, nothing. Throws Refused for anything else that is not
  // the next.
  std::optional<protocol::Message> accept(const protocol::Message& message);

  // The poses over a step. Steps are asked for and answered in order.
  [[nodiscard]] bool has(std::uint64_t step) const;
  // Of the message that waits first. Precondition: has(step) for one of its steps.
  [[nodiscard]] std::uint64_t last_step() const;
  // As the rows that they came in.
  [[nodiscard]] std::span<const double> rows(std::uint64_t step) const;

  // The ledger that came with them; zeros where none did.
  [[nodiscard]] std::span<const double> ledger() const;

  // Notes the fluid's action at the end of a step; the reply when it was the last of its message, with the
  // probes' rows if there are any.
  std::optional<protocol::Message> answer(std::uint64_t step, std::span<const fluid::Wrench> wrenches,
                                          std::span<const double> probes = {});

  // Takes in an Accepted. Throws Refused where it is not that of the exchange answered last.
  void accept_exchange(const Accepted& accepted);
  // What the rigid process decided on the exchange that was answered last, when iterated.
  [[nodiscard]] bool is_decided() const { return !open_ || !batches_.empty(); }
  [[nodiscard]] bool is_repeated() const { return open_.has_value(); }
  [[nodiscard]] const Accepted& accepted() const { return accepted_; }

 private:
  struct Batch {
    std::uint64_t sequence, first_step, count;
    std::uint32_t iteration;
    std::vector<double> kinematics;
    std::vector<double> ledger;
    std::vector<double> wrenches;
  };

  void check(const protocol::Message& message) const;
  void check_turn(const Kinematics& content) const;
  [[nodiscard]] std::uint64_t most_steps(const Kinematics& content) const;
  [[nodiscard]] std::vector<double> read_ledger(const protocol::Message& message) const;
  void check_rows(std::span<const double> rows, std::uint64_t first_step) const;
  [[nodiscard]] protocol::Message reply(const Batch& batch, std::span<const double> probes) const;

  std::size_t bodies_;
  std::uint64_t steps_;
  Terms terms_;
  std::uint64_t last_sequence_ = 0;  // taken in
  std::uint64_t last_step_ = 0;
  std::deque<Batch> batches_;              // not answered yet
  std::deque<protocol::Message> replies_;  // the last kMostUnanswered

  // An exchange that is answered and neither accepted nor repeated.
  struct Open {
    std::uint64_t first_step, count;
    std::uint32_t iteration;
  };
  std::optional<Open> open_;
  Accepted accepted_;
};

}  // namespace sluice::server
