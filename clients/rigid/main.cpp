#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <csignal>

#include "clients/rigid/participant.hpp"
#include "clients/rigid/participant_link.hpp"
#include "protocol/error.hpp"

namespace {

std::atomic<bool> stop{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler writes it");

int exit_code(const sluice::End& end) {
  switch (end.reason()) {
    case sluice::End::FINISHED:
      return sluice::protocol::kDone;
    case sluice::End::UNSTABLE:
      return sluice::protocol::kUnstable;
    default:
      return sluice::protocol::kProcessFailed;
  }
}

int run(const std::string& endpoint, const std::string& keys) {
  try {
    std::optional<sluice::protocol::ClientKeys> client_keys;
    if (!keys.empty()) client_keys = sluice::protocol::ClientKeys::load(keys);
    const sluice::End end = sluice::clients::take_part_as_rigid(endpoint, client_keys, stop);
    spdlog::info("status: {} - {}", sluice::End::Reason_Name(end.reason()), end.detail());
    return exit_code(end);
  } catch (const sluice::protocol::InputError& error) {
    spdlog::error("{}", error.what());
    return sluice::protocol::kBadInput;
  } catch (const sluice::clients::Refused& error) {
    spdlog::error("refused by the server: {}", error.what());
  } catch (const std::exception& error) {
    spdlog::error("{}", error.what());
  }
  return sluice::protocol::kProcessFailed;
}

}  // namespace

int main(int argc, char** argv) {
  spdlog::set_default_logger(spdlog::stderr_logger_st("sluice-rigid"));
  spdlog::set_pattern("[sluice-rigid] %v");
  std::string endpoint, keys;
  CLI::App app("Moves the bodies of a run, and integrates the free ones.");
  app.add_option("--connect", endpoint, "Endpoint of the server: ipc://PATH or tcp://HOST:PORT")->required();
  app.add_option("--keys", keys, "Directory with client.secret and server.public");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? sluice::protocol::kDone : sluice::protocol::kBadInput;
  }
  std::signal(SIGINT, [](int) { stop = true; });
  std::signal(SIGTERM, [](int) { stop = true; });
  return run(endpoint, keys);
}
