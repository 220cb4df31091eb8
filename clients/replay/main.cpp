#include <fmt/core.h>
#include <unistd.h>

#include "clients/record/program.hpp"
#include "clients/replay/publication.hpp"
#include "clients/replay/redrive.hpp"
#include "protocol/endpoint.hpp"

namespace {

using namespace sluice;

struct Arguments {
  std::string recording, keys;
  bool redrive = false, no_wait = false, control = false;
  int threads = 0;
  clients::PublicationOptions publication;
};

int publish(const clients::Reader& recording, Arguments arguments) {
  clients::PublicationOptions& options = arguments.publication;
  if (!arguments.keys.empty()) options.keys = protocol::ServerKeys::load(arguments.keys);
  if (options.endpoint.empty()) options.endpoint = protocol::private_endpoint();
  options.wait = !arguments.no_wait;
  if (arguments.control) options.control = STDIN_FILENO;
  fmt::print("{}\n", options.endpoint);
  std::fflush(stdout);
  if (options.wait) spdlog::info("starts when somebody watches: sluice watch --connect {}", options.endpoint);
  clients::publish(recording, options, clients::stop_requested);
  return clients::stop_requested ? protocol::kProcessFailed : protocol::kDone;
}

int run(const Arguments& arguments) {
  const clients::Reader recording(arguments.recording);
  if (!arguments.redrive) return publish(recording, arguments);
  const auto result = clients::redrive(recording, arguments.threads, clients::stop_requested);
  fmt::print("{}\n", result.text);
  return result.identical ? protocol::kDone : protocol::kProcessFailed;
}

}  // namespace

int main(int argc, char** argv) {
  Arguments arguments;
  CLI::App app("Publishes a recorded run to watchers, or runs the fluid again and compares.");
  app.add_option("recording", arguments.recording, "RUN.h5")->required();
  app.add_option("--listen", arguments.publication.endpoint,
                 "ipc://PATH or tcp://HOST:PORT; default: a private one");
  app.add_option("--speed", arguments.publication.speed, "Simulated over wall-clock time")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--from", arguments.publication.from, "Simulated time [s] to start at")
      ->check(CLI::NonNegativeNumber);
  app.add_flag("--control", arguments.control,
               "Read commands from stdin: pause, play, step [N], seek T, speed X, quit");
  app.add_flag("--no-wait", arguments.no_wait, "Start before anybody watches");
  app.add_option("--keys", arguments.keys, "Directory of keys (sluice keygen); lets other machines watch");
  auto* redrive =
      app.add_flag("--redrive", arguments.redrive,
                   "Run the fluid with the recorded motion; print 'identical' or the first difference");
  app.add_option("--threads", arguments.threads, "Threads of the solver; default: as recorded")
      ->check(CLI::Range(1, 1024))
      ->needs(redrive);
  return clients::run_program("sluice-replay", app, argc, argv, [&] { return run(arguments); });
}
