// The fluid server as a program: reads a scene, listens, runs it with whoever joins.
#include <fmt/format.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>
#include <CLI/CLI.hpp>

#include <csignal>
#include <thread>

#include "protocol/scene_check.hpp"
#include "protocol/scene_file.hpp"
#include "server/run.hpp"

namespace {

using namespace sluice;

std::atomic<bool> interrupted{false};

void on_signal(int) {
  interrupted = true;
}

struct Arguments {
  std::string scene, resume;  // one of them
  std::string listen;
  std::vector<std::string> overrides;
  std::string keys;  // directory; empty: no encryption, this machine only
  int threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  double until = 0;  // [s]; 0: the scene's duration
  server::CheckpointOptions checkpoint;
  double deadline = 4, start_deadline = 30, recorder_deadline = 30;
  bool expect_recorder = false;
};

void declare(CLI::App& app, Arguments& arguments) {
  CLI::Option_group& start = *app.add_option_group("start", "What to run");
  CLI::Option* scene = start.add_option("--scene", arguments.scene, "Scene file, textproto or JSON");
  start.add_option("--resume", arguments.resume, "Checkpoint to go on from");
  start.require_option(1);
  app.add_option("--listen", arguments.listen, "ipc://PATH or tcp://HOST:PORT")->required();
  app.add_option("--keys", arguments.keys, "Directory of keys (sluice keygen); lets other machines connect");
  app.add_option("--set", arguments.overrides, "Change a field of the scene: PATH=VALUE")->needs(scene);
  app.add_option("--threads", arguments.threads, "Threads of the solver")->check(CLI::Range(1, 1024));
  app.add_option("--until", arguments.until, "Simulated time to stop at [s]")->check(CLI::PositiveNumber);
  app.add_flag("--expect-recorder", arguments.expect_recorder, "Wait for a recorder, and for it to keep up");
  CLI::Option* file =
      app.add_option("--checkpoint", arguments.checkpoint.file,
                     "Write the state there when the run is stopped, and every five minutes before");
  app.add_option("--checkpoint-every", arguments.checkpoint.every, "And at each multiple of this time [s]")
      ->check(CLI::PositiveNumber)
      ->needs(file);
  const auto deadline = [&](const char* name, double& value, const char* text) {
    app.add_option(name, value, text)->check(CLI::Range(1e-3, 1e6))->capture_default_str();
  };
  deadline("--deadline", arguments.deadline, "Longest wait for the rigid process in a step [s]");
  deadline("--start-deadline", arguments.start_deadline, "Longest wait for everyone to join [s]");
  deadline("--recorder-deadline", arguments.recorder_deadline, "Longest wait for the recorder [s]");
}

server::Options to_options(const Arguments& arguments) {
  const auto milliseconds = [](double seconds) {
    return std::chrono::milliseconds(static_cast<std::int64_t>(1e3 * seconds));
  };
  return {.expect_recorder = arguments.expect_recorder,
          .deadline = milliseconds(arguments.deadline),
          .start_deadline = milliseconds(arguments.start_deadline),
          .recorder_deadline = milliseconds(arguments.recorder_deadline),
          .interrupted = &interrupted,
          .checkpoint = arguments.checkpoint};
}

server::Simulation start(const Arguments& arguments) {
  const protocol::SceneFile file = protocol::SceneFile::load(arguments.scene, arguments.overrides);
  try {
    return server::make_simulation(file.scene(), arguments.threads, fluid::make_solver, arguments.until);
  } catch (const protocol::SceneError& error) {
    std::vector<protocol::Problem> problems = error.problems();
    for (protocol::Problem& problem : problems) problem.where = file.locate(problem.field);
    throw protocol::SceneError(std::move(problems));
  } catch (const std::invalid_argument& error) {
    throw protocol::InputError(fmt::format("{}: {}", arguments.scene, error.what()));
  }
}

server::Simulation resume(const Arguments& arguments) {
  try {
    return server::resume_simulation(protocol::read_checkpoint(arguments.resume), arguments.threads,
                                     fluid::make_solver, arguments.until);
  } catch (const std::invalid_argument& error) {
    throw protocol::InputError(fmt::format("{}: {}", arguments.resume, error.what()));
  }
}

std::optional<protocol::ServerKeys> load_keys(const std::string& directory) {
  if (directory.empty()) return std::nullopt;
  return protocol::ServerKeys::load(directory);
}

int serve(const Arguments& arguments) {
  const std::optional<protocol::ServerKeys> keys = load_keys(arguments.keys);
  server::Sockets sockets(protocol::Endpoint::parse(arguments.listen, keys.has_value()), keys);
  server::Simulation simulation = arguments.resume.empty() ? start(arguments) : resume(arguments);
  spdlog::info("{}: {} fluid and {} boundary particles, {} steps, {} threads; listening on {}",
               simulation.scene.name(), simulation.fluid_particles, simulation.boundary_particles(),
               simulation.clock.steps(), simulation.threads, sockets.endpoint.exchange);
  if (simulation.resumed.step > 0)
    spdlog::info("going on after step {}, {:g} s", simulation.resumed.step,
                 protocol::seconds(simulation.clock.time(simulation.resumed.step)));
  if (simulation.is_iterated())
    spdlog::info("exchanges with the bodies are iterated, {} step(s) each",
                 simulation.coupling.coupling.steps_per_exchange());
  for (const std::string& line : server::stability_warnings(simulation.scene, simulation.coupling))
    spdlog::warn("{}", line);
  const server::Outcome outcome = server::run(simulation, sockets, to_options(arguments));
  spdlog::info("status: {}", server::to_string(outcome));
  return server::exit_code(outcome.reason);
}

}  // namespace

int main(int argc, char** argv) {
  spdlog::set_default_logger(spdlog::stderr_logger_st("sluice-server"));
  spdlog::set_pattern("[sluice-server] %v");
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);

  CLI::App app("Simulates the liquid of a scene and serves it to a rigid process, a recorder and watchers");
  Arguments arguments;
  declare(app, arguments);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? protocol::kDone : protocol::kBadInput;
  }
  try {
    return serve(arguments);
  } catch (const protocol::InputError& error) {
    spdlog::error("{}", error.what());
    return protocol::kBadInput;
  } catch (const std::exception& error) {
    spdlog::error("internal error: {}", error.what());
    return protocol::kProcessFailed;
  }
}
