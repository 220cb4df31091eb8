#include "clients/record/program.hpp"
#include "clients/record/recorder.hpp"

namespace {

using namespace sluice;

int run(const clients::RecordOptions& options) {
  const clients::RecordOutcome outcome = clients::record(options, clients::stop_requested);
  spdlog::info("{}: {} - {}", options.output.string(), outcome.reason, outcome.detail);
  return outcome.complete ? protocol::kDone : protocol::kProcessFailed;
}

}  // namespace

int main(int argc, char** argv) {
  clients::RecordOptions options;
  std::string keys;
  CLI::App app("Records a run to an HDF5 file (H5MD), acknowledging every frame that is on disk.");
  app.add_option("--connect", options.endpoint, "Endpoint of the server: ipc://PATH or tcp://HOST:PORT")
      ->required();
  app.add_option("-o,--output", options.output, "File to write, RUN.h5")->required();
  app.add_flag("--force", options.force, "Replace an existing file");
  app.add_option("--resume", options.resume, "Go on with this recording, of a run that is resumed")
      ->type_name("RUN.h5");
  app.add_option("--keys", keys, "Directory with client.secret and server.public");
  return clients::run_program("sluice-record", app, argc, argv, [&] {
    options.keys = clients::load_client_keys(keys);
    return run(options);
  });
}
