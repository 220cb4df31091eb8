// Coupling: what the recorder gets, and waiting for it.

#include <spdlog/spdlog.h>

#include "server/coupling.hpp"

namespace sluice::server {

using protocol::Message;
using std::chrono::milliseconds;

namespace {

Stop silent_recorder(milliseconds deadline) {
  return {End::RECORDER_LOST, late("the recorder acknowledged nothing", deadline)};
}

}  // namespace

void Coupling::count(const Message& message) {
  ++outcome_.messages_serialised;
  outcome_.bytes_serialised += bytes_of(message);
}

void Coupling::record(Message message) {
  if (!options_.expect_recorder) return;
  const milliseconds deadline = options_.recorder_deadline;
  wait_until([this] { return recorder_.has_room(); }, deadline, [&] { return silent_recorder(deadline); });
  wait_until([&] { return recorder_.offer(message); }, deadline,
             [&] {
               return Stop(End::RECORDER_LOST,
                           late("the recorder did not connect to the record endpoint", deadline));
             });
}

void Coupling::record_log() {
  if (std::optional<Message> message = log_.take()) {
    stamp(message->header);
    count(*message);
    record(std::move(*message));
  }
}

// Waits for every acknowledgement; the deadline is for each.
void Coupling::drain_recorder() {
  while (recorder_.acknowledged() < recorder_.sent()) {
    const std::uint64_t before = recorder_.acknowledged();
    wait_until([&] { return recorder_.acknowledged() > before; }, options_.recorder_deadline,
               [this] { return silent_recorder(options_.recorder_deadline); });
  }
}

// Sends what `send` has and waits until the recorder has it.
void Coupling::bring_to_recorder(Outcome& outcome, const std::function<void()>& send) {
  if (outcome.reason == End::RECORDER_LOST || !session_.present(RECORDER)) return;
  try {
    send();
    drain_recorder();
  } catch (const Stop& stop) {
    spdlog::warn("while ending: {}", stop.what());
    if (outcome.reason == End::FINISHED) {
      outcome.reason = stop.reason();
      outcome.detail = stop.what();
    }
  }
}

}  // namespace sluice::server
