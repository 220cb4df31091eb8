#pragma once

#include <cstdint>
#include <vector>

#include "clients/recording/layout.hpp"
#include "clients/recording/series.hpp"
#include "protocol/message.hpp"

namespace sluice::clients {

// The particles in the state frames of a recording: a row for each output that has some. Where their number
// varies, a row has as many slots as the largest, and those that a frame does not need are empty.
class ParticleTable {
 public:
  ParticleTable() = default;
  static ParticleTable create(hid_t file, const Welcome& welcome, h5::Storage storage);
  static ParticleTable open(hid_t file, const Welcome& welcome);

  [[nodiscard]] bool has(std::uint64_t frame) const { return frame % every_ == 0; }
  // Throws ProtocolError unless the message's first arrays are these.
  void check(const protocol::Message& frame) const;
  [[nodiscard]] int arrays() const { return static_cast<int>(fields_.size()); }
  // Precondition of both: has(frame).
  void append(const protocol::Message& frame);
  void read(std::uint64_t frame, protocol::Message& message) const;
  // Particles in a frame.
  [[nodiscard]] std::uint64_t count(std::uint64_t frame) const;
  // The most in any.
  [[nodiscard]] std::uint64_t slots() const { return vary_ ? data_.front().slots() : particles_; }

  // Frames that have what they need here, from the first.
  [[nodiscard]] std::uint64_t frames() const;

 private:
  template <typename Make>
  ParticleTable(const Welcome& welcome, Make make);
  [[nodiscard]] h5::Shape shape(const layout::Field& field, std::uint64_t particles) const;

  std::vector<layout::Field> fields_;
  std::vector<h5::Series> data_;
  h5::Series step_, time_;  // of their own where not every frame has particles
  std::uint64_t every_ = 1, particles_ = 0;
  bool vary_ = false;
};

}  // namespace sluice::clients
