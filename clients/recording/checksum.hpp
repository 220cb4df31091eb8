#pragma once

#include <xxhash.h>

#include <cstdint>
#include <memory>
#include <span>

namespace sluice::clients {

// XXH3 (64 bits) over the bytes of everything added.
class Checksum {
 public:
  Checksum() : state_(XXH3_createState(), &XXH3_freeState) { XXH3_64bits_reset(state_.get()); }
  template <typename T>
  Checksum& add(std::span<const T> values) {
    XXH3_64bits_update(state_.get(), values.data(), values.size_bytes());
    return *this;
  }
  template <typename T>
  Checksum& add(T value) {
    return add(std::span<const T>(&value, 1));
  }
  [[nodiscard]] std::uint64_t value() const { return XXH3_64bits_digest(state_.get()); }

 private:
  std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state_;
};

}  // namespace sluice::clients
