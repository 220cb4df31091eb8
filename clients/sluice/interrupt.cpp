#include "clients/sluice/interrupt.hpp"

namespace sluice::clients {
namespace {

volatile std::sig_atomic_t interrupts = 0;

void count(int) {
  interrupts = interrupts + 1;
}

}  // namespace

InterruptCounter::InterruptCounter() {
  interrupts = 0;
  struct sigaction action {};
  action.sa_handler = count;
  sigaction(SIGINT, &action, &before_int_);
  sigaction(SIGTERM, &action, &before_term_);
}

InterruptCounter::~InterruptCounter() {
  sigaction(SIGINT, &before_int_, nullptr);
  sigaction(SIGTERM, &before_term_, nullptr);
}

int InterruptCounter::take() {
  const int now = interrupts;
  const int fresh = now - taken_;
  taken_ = now;
  return fresh;
}

}  // namespace sluice::clients
