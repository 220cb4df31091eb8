#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <type_traits>
#include <vector>
#include <zmq.hpp>

#include "messages.pb.h"
#include "protocol/error.hpp"

namespace sluice::protocol {

// A header and its raw arrays. Move-only, as the arrays are ZeroMQ frames; clone() copies.
class Message {
 public:
  Header header;

  // Appends an array copied from `data`, row-major, whose size must be the product of `shape`.
  template <typename T>
  void add_array(std::string_view name, std::span<const T> data, const std::vector<std::uint64_t>& shape) {
    add_raw(name, type_of<T>(), data.data(), sizeof(T), data.size(), shape);
  }

  // The array of that name; throws ProtocolError when it is absent or of another type.
  template <typename T>
  [[nodiscard]] std::span<const T> array(std::string_view name) const {
    const zmq::message_t& raw = find(name, type_of<T>());
    return {static_cast<const T*>(raw.data()), raw.size() / sizeof(T)};
  }
  [[nodiscard]] bool has_array(std::string_view name) const;
  [[nodiscard]] std::vector<std::uint64_t> shape(std::string_view name) const;

  [[nodiscard]] Message clone() const;
  // XXH3 (64 bits) over the bytes of all arrays in order.
  [[nodiscard]] std::uint64_t hash_arrays() const;

  // The raw frames, for the transport. frames.size() == header.array_size() once validated.
  std::vector<zmq::message_t> frames;

 private:
  template <typename T>
  static constexpr Array::Type type_of() {
    if constexpr (std::is_same_v<T, float>) return Array::FLOAT32;
    if constexpr (std::is_same_v<T, double>) return Array::FLOAT64;
    if constexpr (std::is_same_v<T, std::int32_t>) return Array::INT32;
    if constexpr (std::is_same_v<T, std::int64_t>) return Array::INT64;
    if constexpr (std::is_same_v<T, std::uint64_t>) return Array::UINT64;
    return Array::UNKNOWN;
  }
  void add_raw(std::string_view name, Array::Type type, const void* data, std::size_t element,
               std::size_t count, const std::vector<std::uint64_t>& shape);
  [[nodiscard]] const zmq::message_t& find(std::string_view name, Array::Type type) const;
};

}  // namespace sluice::protocol
