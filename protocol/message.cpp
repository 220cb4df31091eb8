#include "protocol/message.hpp"

#include <cstring>

#include <fmt/format.h>
#include <xxhash.h>

#include "protocol/array_layout.hpp"

namespace sluice::protocol {
namespace {

// Index of the array of that name, or the number of arrays.
int index_of(const Header& header, std::string_view name) {
  int i = 0;
  while (i < header.array_size() && header.array(i).name() != name) ++i;
  return i;
}

}  // namespace

void Message::add_raw(std::string_view name, Array::Type type, const void* data, std::size_t element,
                      std::size_t count, const std::vector<std::uint64_t>& shape) {
  const auto elements = element_count(shape);
  if (type == Array::UNKNOWN || !elements || *elements != count)
    throw std::invalid_argument(
        fmt::format("array {}: {} values do not fill its shape [{}]", name, count, fmt::join(shape, ", ")));
  Array& array = *header.add_array();
  array.set_name(std::string(name));
  array.set_type(type);
  array.mutable_shape()->Add(shape.begin(), shape.end());
  zmq::message_t frame(element * count);
  if (count > 0) std::memcpy(frame.data(), data, element * count);
  frames.push_back(std::move(frame));
}

const zmq::message_t& Message::find(std::string_view name, Array::Type type) const {
  const int i = index_of(header, name);
  if (i == header.array_size()) throw ProtocolError(fmt::format("the message has no array {}", name));
  if (header.array(i).type() != type)
    throw ProtocolError(fmt::format("array {} has type {}, expected {}", name,
                                    Array::Type_Name(header.array(i).type()), Array::Type_Name(type)));
  return frames.at(static_cast<std::size_t>(i));
}

bool Message::has_array(std::string_view name) const {
  return index_of(header, name) < header.array_size();
}

std::vector<std::uint64_t> Message::shape(std::string_view name) const {
  const int i = index_of(header, name);
  if (i == header.array_size()) throw ProtocolError(fmt::format("the message has no array {}", name));
  return {header.array(i).shape().begin(), header.array(i).shape().end()};
}

Message Message::clone() const {
  Message copy;
  copy.header = header;
  copy.frames.reserve(frames.size());
  for (const auto& frame : frames) copy.frames.emplace_back(frame.data(), frame.size());
  return copy;
}

std::uint64_t Message::hash_arrays() const {
  XXH3_state_t* state = XXH3_createState();
  XXH3_64bits_reset(state);
  for (const auto& frame : frames) XXH3_64bits_update(state, frame.data(), frame.size());
  const std::uint64_t hash = XXH3_64bits_digest(state);
  XXH3_freeState(state);
  return hash;
}

}  // namespace sluice::protocol
