#include "server/publisher.hpp"

#include <algorithm>

namespace sluice::server {

namespace {

constexpr std::size_t kLongestTopic = 64;  // a subscription beyond it is not one of ours

}  // namespace

void Publisher::update() {
  zmq::message_t event;
  while (xpub_.recv(event, zmq::recv_flags::dontwait)) {
    // One byte, 1 to subscribe and 0 to leave, then the topic.
    if (event.size() < 1 || event.size() > kLongestTopic) continue;
    const std::string text = event.to_string();
    const std::string topic = text.substr(1);
    if (text[0] == 1) subscriptions_.insert(topic);
    if (text[0] == 0) subscriptions_.erase(topic);
  }
}

bool Publisher::wanted(std::string_view topic) const {
  return std::any_of(subscriptions_.begin(), subscriptions_.end(),
                     [topic](const std::string& subscription) { return topic.starts_with(subscription); });
}

void Publisher::publish(const std::string& topic, const protocol::Message& message) {
  if (wanted(topic)) protocol::send(xpub_, message, topic);
}

}  // namespace sluice::server
