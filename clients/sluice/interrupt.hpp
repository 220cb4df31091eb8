#pragma once

#include <csignal>

namespace sluice::clients {

// Counts SIGINT and SIGTERM, instead of ending the process, while it lives. One at a time.
class InterruptCounter {
 public:
  InterruptCounter();
  ~InterruptCounter();
  InterruptCounter(const InterruptCounter&) = delete;
  InterruptCounter& operator=(const InterruptCounter&) = delete;

  // Interrupts since the last call.
  int take();

 private:
  struct sigaction before_int_ {
  }, before_term_{};
  int taken_ = 0;
};

}  // namespace sluice::clients
