#pragma once

#include <cstdint>
#include <vector>

#include "clients/recording/layout.hpp"
#include "clients/recording/series.hpp"
#include "protocol/message.hpp"
#include "protocol/sim_time.hpp"

namespace sluice::clients {

// What the rigid process and the server told each other, a row a step; row k is step k + 1.
class ExchangeTable {
 public:
  static ExchangeTable create(hid_t file, hsize_t bodies, h5::Storage storage = h5::Storage::kPlain);
  static ExchangeTable open(hid_t file, hsize_t bodies, int format = layout::kFormat);

  // Throws ProtocolError, having written nothing, when the log does not continue the recorded steps.
  void append(const protocol::Message& log, const protocol::StepClock& clock);

  // Steps that all datasets have. The last of them may be incomplete if the writer was killed.
  [[nodiscard]] std::uint64_t length() const;
  [[nodiscard]] protocol::Message read(std::uint64_t first_step, std::uint32_t count) const;
  // Whether what read() gave is what was written, to the last bit.
  [[nodiscard]] bool intact(const protocol::Message& log) const;

 private:
  template <typename Make>
  ExchangeTable(std::vector<layout::Field> fields, Make make);
  void check(const protocol::Message& log) const;

  std::vector<layout::Field> fields_;
  h5::Series step_, time_ns_, checksum_;
  std::vector<h5::Series> data_;
};

}  // namespace sluice::clients
