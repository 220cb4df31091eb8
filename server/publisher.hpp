#pragma once

#include <set>
#include <string>
#include <string_view>

#include "protocol/framing.hpp"

namespace sluice::server {

// Frames and status for whoever watches. A watcher that does not keep up loses messages; nobody waits for it.
class Publisher {
 public:
  explicit Publisher(zmq::socket_t& xpub) : xpub_(xpub) {}

  // Takes in subscriptions that arrived since.
  void update();
  // Somebody subscribes to the topic or a beginning of it, so that a message is worth making.
  [[nodiscard]] bool wanted(std::string_view topic) const;
  void publish(const std::string& topic, const protocol::Message& message);

 private:
  zmq::socket_t& xpub_;
  std::set<std::string> subscriptions_;  // XPUB tells the first and the last of each
};

}  // namespace sluice::server
