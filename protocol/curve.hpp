#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <thread>
#include <zmq.hpp>

namespace sluice::protocol {

// CURVE (encryption and authentication, RFC 26) with keys from files:
//
//   DIR/server.secret      the server's pair, mode 0600
//   DIR/server.public      what a client has to know of the server
//   DIR/client.secret      a client's pair, mode 0600
//   DIR/allowed/*.public   the clients that the server lets in
//
// A server reads the first and the last, a client the two in between. A file has one line "public KEY" and,
// for a pair, one line "secret KEY", in Z85 (40 characters).
struct KeyPair {
  std::string public_key, secret_key;
};

KeyPair make_key_pair();

// Fills DIR (made if need be, mode 0700) with the keys of a server and of one client that it allows.
// Throws InputError when one of the files exists; nothing is written then.
void make_key_files(const std::filesystem::path& directory);

struct ServerKeys {
  KeyPair pair;
  std::set<std::string> allowed;  // public keys of clients

  // Throws InputError naming the file: absent, malformed, or a secret that others may read.
  static ServerKeys load(const std::filesystem::path& directory);
};

struct ClientKeys {
  KeyPair pair;
  std::string server;  // its public key

  static ClientKeys load(const std::filesystem::path& directory);
  // Before the socket is connected.
  void secure(zmq::socket_t& socket) const;
};

// Secures a server's sockets, and answers on a thread of its own ZeroMQ's question whether a client's public
// key may connect (ZAP, RFC 27). Without somebody who answers, ZeroMQ lets every key in: it lives from before
// the sockets are bound until after they are closed. One a context.
class Authenticator {
 public:
  Authenticator(zmq::context_t& context, ServerKeys keys);
  ~Authenticator();
  Authenticator(const Authenticator&) = delete;
  Authenticator& operator=(const Authenticator&) = delete;

  // Before the socket is bound.
  void secure(zmq::socket_t& socket) const;

 private:
  std::string secret_key_;
  zmq::socket_t stop_;
  std::thread thread_;
};

}  // namespace sluice::protocol
