#include "server/stop.hpp"

#include <fmt/format.h>

namespace sluice::server {

std::string to_string(const Outcome& outcome) {
  return fmt::format("{} - {}", End::Reason_Name(outcome.reason), outcome.detail);
}

protocol::ExitCode exit_code(End::Reason reason) {
  switch (reason) {
    case End::FINISHED:
      return protocol::kDone;
    case End::UNSTABLE:
      return protocol::kUnstable;
    default:
      return protocol::kProcessFailed;
  }
}

}  // namespace sluice::server
