#pragma once

#include <stdexcept>
#include <string>

namespace sluice::protocol {

// The peer or the transport broke the protocol; the text names what arrived and what was allowed.
class ProtocolError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// The other side is gone or did not answer in time.
class PeerLost : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// What the user asked for cannot be done; the text names the thing, its value, what is allowed and what to
// do.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Exit codes of every program.
enum ExitCode : int { kDone = 0, kBadInput = 1, kProcessFailed = 2, kUnstable = 3 };

}  // namespace sluice::protocol
