#include <array>
#include <csignal>
#include <string_view>
#include <vector>

#include "protocol/curve.hpp"

namespace sluice::protocol {
namespace {

// Frames of a request (RFC 27); the reply repeats the first two.
enum Request : std::size_t { kVersion, kId, kDomain, kAddress, kIdentity, kMechanism, kKey, kFrames };

std::vector<zmq::message_t> receive_all(zmq::socket_t& socket) {
  std::vector<zmq::message_t> frames;
  do {
    if (!socket.recv(frames.emplace_back())) break;
  } while (frames.back().more());
  return frames;
}

bool is_allowed(const std::vector<zmq::message_t>& request, const std::set<std::string>& allowed) {
  constexpr std::size_t kKeyBytes = 32;
  if (request.size() != kFrames || request[kMechanism].to_string_view() != "CURVE" ||
      request[kKey].size() != kKeyBytes)
    return false;
  std::array<char, 41> text{};
  zmq_z85_encode(text.data(), static_cast<const std::uint8_t*>(request[kKey].data()), kKeyBytes);
  return allowed.contains(text.data());
}

void answer(zmq::socket_t& socket, const std::set<std::string>& allowed) {
  const auto request = receive_all(socket);
  const bool granted = is_allowed(request, allowed);
  const std::string_view id = request.size() > kId ? request[kId].to_string_view() : "";
  const std::string_view status = granted ? "200" : "400";
  const std::string_view reason = granted ? "" : "the key is not in the allow-list";
  const std::array<std::string_view, 6> reply{"1.0", id, status, reason, "", ""};
  for (std::size_t i = 0; i < reply.size(); ++i)
    socket.send(zmq::buffer(reply[i]),
                i + 1 < reply.size() ? zmq::send_flags::sndmore : zmq::send_flags::none);
}

void serve(zmq::socket_t& handler, zmq::socket_t& stop, const std::set<std::string>& allowed) {
  std::array<zmq::pollitem_t, 2> items{
      {{handler.handle(), 0, ZMQ_POLLIN, 0}, {stop.handle(), 0, ZMQ_POLLIN, 0}}};
  while (true) {
    zmq::poll(items.data(), items.size());
    if (items[1].revents != 0) return;
    if (items[0].revents != 0) answer(handler, allowed);
  }
}

// A thread that starts with all signals blocked: they are the main thread's.
std::thread without_signals(const auto& start) {
  sigset_t all, before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  std::thread thread = start();
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  return thread;
}

}  // namespace

Authenticator::Authenticator(zmq::context_t& context, ServerKeys keys)
    : secret_key_(std::move(keys.pair.secret_key)), stop_(context, zmq::socket_type::pair) {
  constexpr const char* kStop = "inproc://sluice.authenticator.stop";
  zmq::socket_t handler(context, zmq::socket_type::rep);
  handler.bind("inproc://zeromq.zap.01");
  stop_.bind(kStop);
  zmq::socket_t stopped(context, zmq::socket_type::pair);
  stopped.connect(kStop);
  thread_ = without_signals([&] {
    return std::thread([handler = std::move(handler), stopped = std::move(stopped),
                        allowed = std::move(keys.allowed)]() mutable {
      try {
        serve(handler, stopped, allowed);
      } catch (const zmq::error_t&) {
        // the context is closing, and every socket of it with it
      }
    });
  });
}

Authenticator::~Authenticator() {
  zmq_send(stop_.handle(), "", 0, ZMQ_DONTWAIT);
  thread_.join();
}

void Authenticator::secure(zmq::socket_t& socket) const {
  socket.set(zmq::sockopt::curve_server, true);
  socket.set(zmq::sockopt::curve_secretkey, secret_key_);
}

}  // namespace sluice::protocol
