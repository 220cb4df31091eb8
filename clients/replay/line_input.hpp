#pragma once

#include <string>
#include <vector>
#include <zmq.hpp>

namespace sluice::clients {

// Lines from a descriptor that is polled, such as a terminal.
class LineInput {
 public:
  // -1: no input.
  explicit LineInput(int descriptor) : descriptor_(descriptor) {}

  // Until its end has been read.
  [[nodiscard]] bool is_open() const { return descriptor_ >= 0; }
  [[nodiscard]] zmq::pollitem_t poll_item() const { return {nullptr, descriptor_, ZMQ_POLLIN, 0}; }
  // The lines that are complete. Blocks unless the descriptor has something.
  std::vector<std::string> read();

 private:
  int descriptor_;
  std::string begun_;
};

}  // namespace sluice::clients
