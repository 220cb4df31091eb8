#pragma once

#include <atomic>
#include <chrono>
#include <filesystem>
#include <optional>
#include <string>

#include "protocol/curve.hpp"

namespace sluice::clients {

struct RecordOptions {
  std::string endpoint;
  std::filesystem::path output;
  bool force = false;  // replace an existing file
  // Of a run that is resumed: its recording so far, which may be the output.
  std::filesystem::path resume{};
  std::optional<protocol::ClientKeys> keys;
  std::chrono::milliseconds patience{30000};  // with a server that does not answer the greeting
};

// How a recording ended, as it is written in the file.
struct RecordOutcome {
  std::string reason, detail;
  bool complete = false;  // the server's End has come
};

// Records one run from the greeting to the server's End. The output is checked before the greeting; it is
// touched only when the server has welcomed the recorder. A server that is lost, or `stop`, ends the file
// properly. Throws InputError (output or endpoint not usable), ProtocolError (refused), PeerLost (no server),
// and std::runtime_error when writing fails.
RecordOutcome record(const RecordOptions& options, const std::atomic<bool>& stop);

}  // namespace sluice::clients
