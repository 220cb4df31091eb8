#pragma once

#include <cstdint>
#include <vector>

#include "clients/recording/layout.hpp"
#include "clients/recording/particle_table.hpp"
#include "clients/recording/series.hpp"
#include "protocol/message.hpp"

namespace sluice::clients {

// The state frames of a recording: a row in each of its datasets.
class FrameTable {
 public:
  static FrameTable create(hid_t file, const Welcome& welcome, h5::Storage storage = h5::Storage::kPlain);
  static FrameTable open(hid_t file, const Welcome& welcome);

  // Throws ProtocolError, having written nothing, when the frame is not the next or not what it says.
  void append(const protocol::Message& frame);

  // Rows that all datasets have. The last of them may be incomplete if the writer was killed.
  [[nodiscard]] std::uint64_t length() const;
  // Particles in a frame; 0 in one that was to have none.
  [[nodiscard]] std::uint64_t particles(std::uint64_t index) const;
  // The most in any.
  [[nodiscard]] std::uint64_t slots() const { return particles_.slots(); }
  // Step, time, index, hash and energies as recorded.
  [[nodiscard]] Header header(std::uint64_t index) const;
  // The same with the arrays.
  [[nodiscard]] protocol::Message read(std::uint64_t index) const;
  // Whether what read() gave is what was written, to the last bit.
  [[nodiscard]] bool intact(const protocol::Message& frame) const;

 private:
  template <typename Make>
  FrameTable(const Welcome& welcome, Make make);
  void check(const protocol::Message& frame) const;

  ParticleTable particles_;
  std::vector<layout::Field> fields_;
  std::vector<layout::Observable> observables_;
  h5::Series step_, time_, time_ns_, hash_, checksum_;
  std::vector<h5::Series> data_, energy_;
};

}  // namespace sluice::clients
