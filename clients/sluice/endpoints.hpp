#pragma once

#include <string>

#include "protocol/endpoint.hpp"

namespace sluice::clients {

// Tries the endpoint and lets it go again. Throws InputError when a server listens there or it cannot be
// used.
void require_free(const protocol::Endpoint& endpoint);

// A fresh endpoint for one run, whose directory goes with this object.
class PrivateEndpoint {
 public:
  PrivateEndpoint();
  ~PrivateEndpoint();
  PrivateEndpoint(const PrivateEndpoint&) = delete;
  PrivateEndpoint& operator=(const PrivateEndpoint&) = delete;
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  std::string text_;
};

}  // namespace sluice::clients
