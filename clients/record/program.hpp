#pragma once

#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <atomic>
#include <csignal>
#include <functional>
#include <optional>
#include <string>

#include "protocol/curve.hpp"
#include "protocol/error.hpp"

namespace sluice::clients {

// Set by SIGINT and SIGTERM once run_program has begun.
inline std::atomic<bool> stop_requested{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler writes it");

inline std::optional<protocol::ClientKeys> load_client_keys(const std::string& directory) {
  if (directory.empty()) return std::nullopt;
  return protocol::ClientKeys::load(directory);
}

// What the programs of the clients have in common: the log on stderr, the command line, signals, exit codes.
inline int run_program(const std::string& name, CLI::App& app, int argc, char** argv,
                       const std::function<int()>& run) {
  spdlog::set_default_logger(spdlog::stderr_logger_st(name));
  spdlog::set_pattern("[" + name + "] %v");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? protocol::kDone : protocol::kBadInput;
  }
  std::signal(SIGINT, [](int) { stop_requested = true; });
  std::signal(SIGTERM, [](int) { stop_requested = true; });
  try {
    return run();
  } catch (const protocol::InputError& error) {
    spdlog::error("{}", error.what());
    return protocol::kBadInput;
  } catch (const std::exception& error) {
    spdlog::error("{}", error.what());
    return protocol::kProcessFailed;
  }
}

}  // namespace sluice::clients
