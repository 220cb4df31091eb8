#include "protocol/framing.hpp"

#include <cerrno>
#include <cstring>
#include <unordered_set>

#include <fmt/format.h>
#include <google/protobuf/stubs/logging.h>

#include "protocol/array_layout.hpp"

namespace sluice::protocol {
namespace {

constexpr std::size_t kLongestName = 128;
constexpr int kMostExtents = 8;

bool send_frame(zmq::socket_t& socket, zmq::message_t& frame, bool more) {
  const auto flags = zmq::send_flags::dontwait | (more ? zmq::send_flags::sndmore : zmq::send_flags::none);
  while (true) {
    try {
      return socket.send(frame, flags).has_value();
    } catch (const zmq::error_t& error) {
      if (error.num() == EHOSTUNREACH) return false;
      if (error.num() != EINTR) throw;
    }
  }
}

// A second frame on the same bytes: ZeroMQ counts references to them and never writes.
zmq::message_t share(const zmq::message_t& frame) {
  zmq::message_t shared;
  shared.copy(const_cast<zmq::message_t&>(frame));
  return shared;
}

// Small frames lie anywhere in ZeroMQ's read buffer; spans of doubles need them aligned.
zmq::message_t aligned(zmq::message_t frame) {
  if (reinterpret_cast<std::uintptr_t>(frame.data()) % alignof(double) == 0) return frame;
  return {frame.data(), frame.size()};
}

bool starts_with_identity(zmq::socket_t& socket) {
  const int type = socket.get(zmq::sockopt::type);
  return type == ZMQ_ROUTER || type == ZMQ_SUB;
}

// All frames of one message. Reads every one of them even when there are too many: the rest would be
// taken for the next message. Keeps none beyond the limits.
struct Raw {
  std::vector<zmq::message_t> frames;
  std::size_t count = 0;
  std::size_t bytes = 0;
};

std::optional<Raw> read_all(zmq::socket_t& socket, const Limits& limits) {
  Raw raw;
  bool more = true;
  while (more) {
    zmq::message_t frame;
    try {
      if (!socket.recv(frame, zmq::recv_flags::dontwait)) return std::nullopt;
    } catch (const zmq::error_t& error) {
      if (error.num() != EINTR) throw;
      if (raw.count == 0) return std::nullopt;
      continue;
    }
    more = frame.more();
    ++raw.count;
    raw.bytes += frame.size();
    if (raw.count > limits.frames || raw.bytes > limits.total_bytes)
      raw.frames.clear();
    else
      raw.frames.push_back(std::move(frame));
  }
  return raw;
}

void check_array(const Array& array, const zmq::message_t& frame) {
  if (array.name().empty() || array.name().size() > kLongestName)
    throw ProtocolError(fmt::format("an array's name has {} characters, allowed are 1 to {}",
                                    array.name().size(), kLongestName));
  const std::uint64_t element = element_size(array.type());
  if (element == 0)
    throw ProtocolError(
        fmt::format("array {} has unknown type {}", array.name(), static_cast<int>(array.type())));
  if (array.shape_size() > kMostExtents)
    throw ProtocolError(fmt::format("array {} has {} extents, allowed are {}", array.name(),
                                    array.shape_size(), kMostExtents));
  const auto elements = element_count(array.shape());
  if (!elements || *elements * element != frame.size())
    throw ProtocolError(
        fmt::format("array {} of shape [{}] and {} bytes an element does not match its frame of {} bytes",
                    array.name(), fmt::join(array.shape(), ", "), element, frame.size()));
}

Header parse_header(const zmq::message_t& frame, const Limits& limits) {
  if (frame.size() > limits.header_bytes)
    throw ProtocolError(
        fmt::format("a header of {} bytes, allowed are {}", frame.size(), limits.header_bytes));
  const google::protobuf::LogSilencer quiet;  // a peer must not fill our log
  Header header;
  if (!header.ParseFromArray(frame.data(), static_cast<int>(frame.size())))
    throw ProtocolError(fmt::format("{} bytes that are not a header", frame.size()));
  return header;
}

void check_arrays(const Message& message) {
  const Header& header = message.header;
  if (static_cast<std::size_t>(header.array_size()) != message.frames.size())
    throw ProtocolError(
        fmt::format("the header announces {} arrays, {} came", header.array_size(), message.frames.size()));
  std::unordered_set<std::string_view> names;
  for (int i = 0; i < header.array_size(); ++i) {
    check_array(header.array(i), message.frames[static_cast<std::size_t>(i)]);
    if (!names.insert(header.array(i).name()).second)
      throw ProtocolError(fmt::format("two arrays are named {}", header.array(i).name()));
  }
}

}  // namespace

bool send(zmq::socket_t& socket, const Message& message, const std::string& identity) {
  std::vector<zmq::message_t> parts;
  if (!identity.empty()) parts.emplace_back(identity.data(), identity.size());
  zmq::message_t& header = parts.emplace_back(message.header.ByteSizeLong());
  message.header.SerializeToArray(header.data(), static_cast<int>(header.size()));
  for (const auto& frame : message.frames) parts.push_back(share(frame));

  // ZeroMQ drops the rest of a message whose peer vanishes midway; it has to be handed over all the same.
  bool sent = true;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    sent = send_frame(socket, parts[i], i + 1 < parts.size()) && sent;
    if (i == 0 && !sent) return false;
  }
  return sent;
}

std::optional<Received> receive(zmq::socket_t& socket, const Limits& limits) {
  auto raw = read_all(socket, limits);
  if (!raw) return std::nullopt;
  if (raw->count > limits.frames || raw->bytes > limits.total_bytes)
    throw ProtocolError(fmt::format("a message of {} frames and {} bytes, allowed are {} and {}", raw->count,
                                    raw->bytes, limits.frames, limits.total_bytes));
  Received received;
  auto next = raw->frames.begin();
  if (starts_with_identity(socket)) received.identity = (next++)->to_string();
  if (next == raw->frames.end()) throw ProtocolError("a message without a header");
  received.message.header = parse_header(*next++, limits);
  for (; next != raw->frames.end(); ++next) received.message.frames.push_back(aligned(std::move(*next)));
  check_arrays(received.message);
  return received;
}

std::optional<Received> receive_within(zmq::socket_t& socket, int timeout_ms, const Limits& limits) {
  zmq::pollitem_t item{socket.handle(), 0, ZMQ_POLLIN, 0};
  try {
    if (zmq::poll(&item, 1, std::chrono::milliseconds(timeout_ms)) == 0) return std::nullopt;
  } catch (const zmq::error_t& error) {
    if (error.num() != EINTR) throw;
    return std::nullopt;  // a signal: the caller looks at its flags
  }
  return receive(socket, limits);
}

}  // namespace sluice::protocol
