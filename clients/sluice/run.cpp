#include "clients/sluice/run.hpp"

#include <spdlog/spdlog.h>

#include <iostream>
#include <optional>

#include "clients/recording/output_file.hpp"
#include "clients/sluice/check.hpp"
#include "clients/sluice/endpoints.hpp"
#include "clients/sluice/session.hpp"

namespace sluice::clients {
namespace {

// Everything that can be wrong is tried before anything is started; OutputFile leaves nothing behind.
void require_runnable(const RunOptions& options, const std::string& endpoint) {
  const Estimate estimate = require_sound(options.check);
  if (!options.output.empty()) const OutputFile trial(options.output, options.force);
  require_free(protocol::Endpoint::parse(endpoint, !options.keys.empty()));
  spdlog::info("{}: {}", options.check.scene.string(), to_string(estimate));
}

// A script that asked for JSON gets its object also when nothing was started.
void print_refusal(const RunOptions& options, const std::string& reason) {
  Summary summary;
  summary.file = options.check.scene.string();
  summary.status = "BAD_INPUT";
  summary.detail = reason;
  summary.exit_code = protocol::kBadInput;
  std::cout << to_json(summary) << std::endl;
}

int run_to_end(const RunOptions& options) {
  std::optional<PrivateEndpoint> own;
  if (options.listen.empty()) own.emplace();
  const std::string endpoint = own ? own->text() : options.listen;
  require_runnable(options, endpoint);

  Session session(options, endpoint);
  const Summary summary = session.follow();
  std::cerr << session.failure_report();
  std::cout << (options.json ? to_json(summary) + "\n" : to_table(summary)) << std::flush;
  return summary.exit_code;
}

}  // namespace

int run(const RunOptions& options) {
  try {
    return run_to_end(options);
  } catch (const protocol::InputError& error) {
    if (options.json) print_refusal(options, error.what());
    throw;
  }
}

}  // namespace sluice::clients
