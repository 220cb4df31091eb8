#pragma once

#include <string>
#include <vector>
#include <zmq.hpp>

#include "clients/sluice/crew.hpp"
#include "clients/sluice/interrupt.hpp"
#include "clients/sluice/progress.hpp"
#include "clients/sluice/run.hpp"
#include "clients/sluice/server_link.hpp"
#include "clients/sluice/summary.hpp"

namespace sluice::clients {

// One run from the start of its server to the end of the last process. Options have been checked.
class Session {
 public:
  Session(const RunOptions& options, const std::string& endpoint);

  // Blocks until every process has ended.
  Summary follow();
  // What failed programs said last, for people; empty when the run ended as it should.
  [[nodiscard]] std::string failure_report() { return crew_.failure_report(); }

 private:
  void start_server();
  void start_participants(const Welcome& welcome);
  void wait_for_news();
  void take_news();
  void note(const Header& header);
  void conclude();
  void read_recording();
  [[nodiscard]] std::vector<std::string> connection() const;

  const RunOptions& options_;
  std::string endpoint_;
  InterruptCounter interrupts_;
  zmq::context_t context_;
  ServerLink link_;
  Progress progress_;
  Crew crew_;
  Summary summary_;
};

}  // namespace sluice::clients
