#pragma once

#include <filesystem>
#include <string>
#include <zmq.hpp>

namespace sluice::protocol {

// The three addresses of a server: `exchange` (ROUTER) as given; `publish` (XPUB) and `record` (PUSH)
// derived from it: ipc path + ".publish" / ".record"; tcp port + 1 / + 2.
struct Endpoint {
  std::string exchange, publish, record;

  // Accepts ipc://PATH and tcp://HOST:PORT. Throws InputError for anything else; for a path too long for
  // a socket; and for a tcp host that is not loopback unless `allow_remote`.
  static Endpoint parse(const std::string& text, bool allow_remote = false);
};

// A fresh ipc endpoint in a directory of mode 0700 below XDG_RUNTIME_DIR or the temporary directory.
std::string private_endpoint();

// Holds an ipc endpoint against a second server: an exclusive lock on PATH.lock beside the socket. Removes
// socket files and lock when it goes. Nothing to do for tcp. Throws InputError when another process holds it.
class EndpointLock {
 public:
  explicit EndpointLock(const Endpoint& endpoint);
  ~EndpointLock();
  EndpointLock(const EndpointLock&) = delete;
  EndpointLock& operator=(const EndpointLock&) = delete;

 private:
  int descriptor_ = -1;
  std::filesystem::path socket_;
};

// A socket with the project's safe options: no lingering beyond one second, bounded message size, ZMTP
// heartbeats (a stopped peer is noticed within 3 s), ROUTER with MANDATORY.
zmq::socket_t make_socket(zmq::context_t& context, zmq::socket_type type);

// Binds or throws InputError naming the endpoint and the reason (in use, not permitted ...).
void bind(zmq::socket_t& socket, const std::string& endpoint);

}  // namespace sluice::protocol
