#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>

#include "messages.pb.h"
#include "protocol/error.hpp"

namespace sluice::server {

// Thrown anywhere inside a run to end it before its last step; caught once, in run().
class Stop : public std::runtime_error {
 public:
  Stop(End::Reason reason, const std::string& detail) : std::runtime_error(detail), reason_(reason) {}
  [[nodiscard]] End::Reason reason() const { return reason_; }

 private:
  End::Reason reason_;
};

// A participant's message that is not accepted; it is told so, and the run goes on.
class Refused : public std::runtime_error {
 public:
  Refused(Refusal::Code code, const std::string& reason) : std::runtime_error(reason), code_(code) {}
  [[nodiscard]] Refusal::Code code() const { return code_; }

 private:
  Refusal::Code code_;
};

// How a run ended.
struct Outcome {
  End::Reason reason = End::UNKNOWN;
  std::string detail;
  std::uint64_t steps = 0;  // done
  // Made for the recorder and for watchers; nothing when nobody wanted any.
  std::uint64_t frames_serialised = 0, messages_serialised = 0, bytes_serialised = 0;
};

// "FINISHED - 4000 steps, 0.4 s simulated"
std::string to_string(const Outcome& outcome);

protocol::ExitCode exit_code(End::Reason reason);

}  // namespace sluice::server
