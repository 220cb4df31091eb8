#include <fmt/core.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>

#include "clients/record/connection.hpp"
#include "clients/record/program.hpp"
#include "protocol/framing.hpp"
#include "protocol/sim_time.hpp"

namespace {

using namespace sluice;
using std::chrono::milliseconds;
using std::chrono::steady_clock;

constexpr milliseconds kSlice{100};
constexpr int kLastMessages = 300;  // [ms] for what a server that has gone still sent

std::string describe(const Header& header, double duration) {
  const Status& status = header.status();
  const double share = status.steps() > 0
                           ? 100.0 * static_cast<double>(header.step()) / static_cast<double>(status.steps())
                           : 0;
  return fmt::format("t = {:.4f} / {:.4f} s  step {} / {}  {:.1f} %  {:.0f} steps/s",
                     protocol::seconds(header.time_ns()), duration, header.step(), status.steps(), share,
                     status.steps_per_second());
}

class Watcher {
 public:
  Watcher(const protocol::Endpoint& endpoint, const std::optional<protocol::ClientKeys>& keys)
      : connection_(context_, endpoint, keys), news_(protocol::make_socket(context_, zmq::socket_type::sub)) {
    if (keys) keys->secure(news_);
    news_.set(zmq::sockopt::subscribe, "status");
    news_.connect(endpoint.publish);
    connection_.greet(WATCHER, "sluice-watch");
  }

  // Until the End, which it returns.
  End watch() {
    while (!end_) {
      if (clients::stop_requested) throw std::runtime_error("interrupted");
      zmq::pollitem_t items[] = {{news_.handle(), 0, ZMQ_POLLIN, 0}, connection_.poll_item()};
      clients::wait_for_any(items, kSlice);
      while (auto message = connection_.receive()) meet(message->header);
      take_news(0);
      if (!end_) watch_server();
    }
    if (on_terminal_) fmt::print("\n");
    return *end_;
  }

 private:
  void meet(const Header& header) {
    if (!header.has_welcome()) return;
    const Welcome& welcome = header.welcome();
    duration_ = welcome.scene().duration();
    fmt::print("{}: {} fluid and {} boundary particles, {} bodies, {} steps\n", welcome.scene().name(),
               welcome.fluid_particles(), welcome.boundary_particles(), welcome.scene().body_size(),
               welcome.steps());
    std::fflush(stdout);
  }

  void take_news(int patience) {
    while (auto received = protocol::receive_within(news_, patience)) {
      connection_.hear();
      const Header& header = received->message.header;
      if (header.has_status()) show(header);
      if (header.has_end()) end_ = header.end();
      if (end_) return;
    }
  }

  // The End may have come by the other socket.
  void watch_server() {
    try {
      connection_.watch();
    } catch (const protocol::PeerLost&) {
      take_news(kLastMessages);
      if (!end_) throw;
    }
  }

  // Ten times a second on a terminal, a line a second elsewhere.
  void show(const Header& header) {
    const auto now = steady_clock::now();
    const bool last = header.step() == header.status().steps();
    if (!on_terminal_ && !last && now - shown_ < std::chrono::seconds(1)) return;
    shown_ = now;
    const std::string line = describe(header, duration_);
    fmt::print("{}", on_terminal_ ? "\r\x1b[K" + line : line + "\n");
    std::fflush(stdout);
  }

  zmq::context_t context_;
  clients::Connection connection_;
  zmq::socket_t news_;
  std::optional<End> end_;
  double duration_ = 0;
  bool on_terminal_ = isatty(STDOUT_FILENO) == 1;
  steady_clock::time_point shown_;
};

// The exit code is that of the run.
int run(const std::string& endpoint, const std::string& keys) {
  const auto client_keys = clients::load_client_keys(keys);
  const End end = Watcher(protocol::Endpoint::parse(endpoint, client_keys.has_value()), client_keys).watch();
  fmt::print("status: {} - {}\n", End::Reason_Name(end.reason()), end.detail());
  switch (end.reason()) {
    case End::FINISHED:
      return protocol::kDone;
    case End::UNSTABLE:
      return protocol::kUnstable;
    default:
      return protocol::kProcessFailed;
  }
}

}  // namespace

int main(int argc, char** argv) {
  std::string endpoint, keys;
  CLI::App app("Shows how far a run is.");
  app.add_option("--connect", endpoint, "Endpoint of the server: ipc://PATH or tcp://HOST:PORT")->required();
  app.add_option("--keys", keys, "Directory with client.secret and server.public");
  return clients::run_program("sluice-watch", app, argc, argv, [&] { return run(endpoint, keys); });
}
