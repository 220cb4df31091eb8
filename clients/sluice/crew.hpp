#pragma once

#include <chrono>
#include <memory>
#include <string>
#include <vector>
#include <zmq.hpp>

#include "clients/sluice/process.hpp"

namespace sluice::clients {

// The processes of one run: the server and whoever takes part. The server decides how the run ends and tells
// the others; this class only steps in when somebody does not follow.
class Crew {
 public:
  explicit Crew(Child::OnLine on_line) : on_line_(std::move(on_line)) {}

  // Starts a sibling program; the first one is the server.
  void start(const std::string& program, const std::vector<std::string>& arguments);

  void add_outputs(std::vector<zmq::pollitem_t>& items) const;
  void read_outputs();
  [[nodiscard]] bool all_ended();

  // A user's interrupt: the first asks the server to end the run in order, the next ends all at once.
  void interrupt();
  // Ends what outlives the others: participants without a server, a server whose participant failed.
  void stop_stragglers();

  // The server's exit code; where it had to be stopped, that of the participant that failed. A program that
  // a signal ended counts as failed.
  [[nodiscard]] int exit_code();
  // What each failed program said last; empty when none failed, or after interrupt().
  [[nodiscard]] std::string failure_report();
  [[nodiscard]] const Child& server() const { return *children_.front(); }

 private:
  using Instant = std::chrono::steady_clock::time_point;

  [[nodiscard]] bool someone_ended_badly();
  void signal_all(int number);

  Child::OnLine on_line_;
  std::vector<std::unique_ptr<Child>> children_;
  int interrupts_ = 0;
  bool server_stopped_ = false;
  Instant alone_since_{};
};

}  // namespace sluice::clients
