#include "clients/sluice/endpoints.hpp"

#include <filesystem>
#include <string_view>

namespace sluice::clients {

namespace fs = std::filesystem;
namespace {

constexpr std::string_view kIpc = "ipc://";

void bind_and_release(zmq::context_t& context, const std::string& endpoint) {
  zmq::socket_t socket = protocol::make_socket(context, zmq::socket_type::router);
  protocol::bind(socket, endpoint);
}

}  // namespace

void require_free(const protocol::Endpoint& endpoint) {
  const protocol::EndpointLock lock(endpoint);
  zmq::context_t context;  // its end waits until the sockets are closed
  for (const std::string& address : {endpoint.exchange, endpoint.publish, endpoint.record})
    bind_and_release(context, address);
}

PrivateEndpoint::PrivateEndpoint() : text_(protocol::private_endpoint()) {}

PrivateEndpoint::~PrivateEndpoint() {
  std::error_code ignored;
  fs::remove_all(fs::path(text_.substr(kIpc.size())).parent_path(), ignored);
}

}  // namespace sluice::clients
