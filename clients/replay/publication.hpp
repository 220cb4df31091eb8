#pragma once

#include <atomic>
#include <optional>
#include <string>

#include "clients/recording/reader.hpp"
#include "protocol/curve.hpp"

namespace sluice::clients {

struct PublicationOptions {
  std::string endpoint;
  double speed = 1;  // simulated over wall-clock time
  double from = 0;   // simulated [s] to start at
  bool wait = true;  // for somebody who watches, before it starts
  int control = -1;  // descriptor that commands come from, a line each (playback.hpp); -1: none
  std::optional<protocol::ServerKeys> keys;
};

// Publishes a recording as the server published the run: a watcher cannot tell the difference. Returns after
// the End, or when `stop` is set. Throws InputError when the endpoint cannot be used or a frame is damaged.
void publish(const Reader& recording, const PublicationOptions& options, const std::atomic<bool>& stop);

}  // namespace sluice::clients
