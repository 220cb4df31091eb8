#include <fmt/core.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <array>
#include <iostream>
#include <string>
#include <vector>

#include "clients/recording/archive.hpp"
#include "clients/recording/inspect.hpp"
#include "clients/recording/repair.hpp"
#include "clients/sluice/check.hpp"
#include "clients/sluice/run.hpp"
#include "clients/sluice/siblings.hpp"
#include "protocol/curve.hpp"
#include "protocol/error.hpp"
#include "protocol/version.hpp"

namespace sluice::clients {
namespace {

// A command that another program or Python module does, with the same arguments.
struct Forwarded {
  const char* command;
  const char* program;
  const char* what;
};
constexpr std::array kForwarded{
    Forwarded{"serve", "sluice-server", "Run the fluid server: --scene FILE --listen ENDPOINT"},
    Forwarded{"rigid", "sluice-rigid", "Run the rigid bodies: --connect ENDPOINT"},
    Forwarded{"record", "sluice-record", "Record a run: --connect ENDPOINT -o RUN.h5"},
    Forwarded{"watch", "sluice-watch", "Follow a run as text: --connect ENDPOINT"},
    Forwarded{"replay", "sluice-replay",
              "Publish a recorded run, or compute it again with --redrive: RUN.h5"},
    Forwarded{"bench", "sluice-bench", "Measure: accuracy, stability, speed, recording"},
};

constexpr std::array kPython{
    Forwarded{"plot", "sluice.plot",
              "Draw recordings: fields, bodies, probes, energies, ledgers: RUN.h5 -o PICTURE.png"},
    Forwarded{"movie", "sluice.movie", "Make a movie of a recording: RUN.h5 -o MOVIE.gif"},
    Forwarded{"export", "sluice.export",
              "Write a recording for ParaView or as tables: RUN.h5 --to vtk|csv DIR"},
    Forwarded{"diff", "sluice.diff", "Say how far two recordings are apart: A.h5 B.h5"},
};

// Everything after the command belongs to the other program, --help included.
CLI::App* add_forwarding(CLI::App& app, const char* command, const char* what) {
  CLI::App* sub = app.add_subcommand(command, what);
  sub->prefix_command()->set_help_flag();
  return sub;
}

[[noreturn]] void become_module(const std::string& module, const std::vector<std::string>& arguments) {
  std::vector<std::string> words{"-m", module};
  words.insert(words.end(), arguments.begin(), arguments.end());
  become_python(std::move(words));
}

void add_scene(CLI::App& command, CheckOptions& options) {
  command.add_option("scene", options.scene, "Scene file: *.scene (textproto) or *.json")->required();
  command
      .add_option("--set", options.overrides,
                  "Set a field of the scene, e.g. spacing=0.002, body[0].density=500")
      ->type_name("PATH=VALUE")
      ->expected(1)
      ->take_all();
}

// What a run takes, whether it starts or goes on.
void add_run_options(CLI::App& run, RunOptions& options) {
  run.add_flag("--force", options.force, "Replace an existing recording");
  run.add_option("--checkpoint-every", options.checkpoint_every,
                 "Write a checkpoint at each multiple of this simulated time [s]; default every five minutes")
      ->check(CLI::PositiveNumber)
      ->type_name("T");
  run.add_option("--threads", options.threads, "Threads of the server; default all processors")
      ->check(CLI::PositiveNumber)
      ->type_name("N");
  run.add_option("--until", options.until, "Simulated time [s] to stop at, before the scene's duration")
      ->check(CLI::PositiveNumber)
      ->type_name("T");
  run.add_option("--listen", options.listen, "Where watchers can connect; default a private endpoint")
      ->type_name("ENDPOINT");
  run.add_option("--keys", options.keys, "Directory of CURVE keys (sluice keygen)")->type_name("DIR");
  run.add_flag("--json", options.json, "Print the summary as one JSON object");
  run.add_flag("--verbose", options.verbose, "Show what the processes log");
}

CLI::App* add_run(CLI::App& app, RunOptions& options) {
  CLI::App* run =
      app.add_subcommand("run", "Check a scene and run it: server, rigid bodies and recorder together");
  add_scene(*run, options.check);
  run->add_option("-o,--output", options.output, "Record to this file")->type_name("RUN.h5");
  add_run_options(*run, options);
  return run;
}

CLI::App* add_resume(CLI::App& app, RunOptions& options) {
  CLI::App* resume = app.add_subcommand("resume", "Go on with a run from a checkpoint, bit for bit");
  resume->add_option("checkpoint", options.resume, "RUN.checkpoint")->required();
  resume
      ->add_option("--recording", options.recording,
                   "The recording of the run so far; default the one beside the checkpoint")
      ->type_name("RUN.h5");
  resume->add_option("-o,--output", options.output, "Record to this file; default the recording so far")
      ->type_name("NEW.h5");
  add_run_options(*resume, options);
  return resume;
}

int make_keys(const std::string& directory) {
  protocol::make_key_files(directory);
  std::cout << fmt::format(
      "{0}/server.secret  {0}/allowed/  stay with the server\n"
      "{0}/client.secret  {0}/server.public  go to the client's machine\n",
      directory);
  return protocol::kDone;
}

int inspect_file(const std::string& path, bool json) {
  const Reader recording(path);
  std::cout << (json ? inspect_json(recording) : inspect(recording)) << std::flush;
  return protocol::kDone;
}

int repair_file(const std::string& path, const std::string& output) {
  std::cout << to_text(repair(path, output), path) << std::flush;
  return protocol::kDone;
}

int archive_file(const std::string& path, const std::string& copy, bool force) {
  std::cout << archive(path, copy, force) << std::flush;
  return protocol::kDone;
}

int front_end(int argc, char** argv) {
  CLI::App app{
      "Free-surface flow with moving bodies: moving-least-squares SPH and Bullet as separate processes."};
  app.name("sluice");
  app.require_subcommand(1);
  app.set_version_flag("--version",
                       fmt::format("sluice {} (protocol {})", SLUICE_VERSION, protocol::kProtocolVersion));

  RunOptions run_options, resume_options;
  CheckOptions check_options;
  std::string recording, key_directory;
  bool json = false;
  CLI::App* run_command = add_run(app, run_options);
  CLI::App* resume_command = add_resume(app, resume_options);
  CLI::App* check_command =
      app.add_subcommand("check", "Say what is wrong with a scene, and what it will cost");
  add_scene(*check_command, check_options);
  for (const Forwarded& forwarded : kForwarded) add_forwarding(app, forwarded.command, forwarded.what);
  CLI::App* inspect_command = app.add_subcommand("inspect", "Say what is in a recording");
  inspect_command->add_option("recording", recording, "RUN.h5")->required();
  inspect_command->add_flag("--json", json, "Print one JSON object");
  for (const Forwarded& python : kPython) add_forwarding(app, python.command, python.what);
  CLI::App* python_command =
      add_forwarding(app, "python", "Run a Python program with the package sluice: PROGRAM.py ...");
  std::string copy;
  CLI::App* repair_command =
      app.add_subcommand("repair", "Make a recording whole whose recorder was killed, or that is damaged");
  repair_command->add_option("recording", recording, "RUN.h5")->required();
  repair_command->add_option("-o,--output", copy, "Write the repaired recording there")->type_name("NEW.h5");
  bool replace = false;
  CLI::App* archive_command = app.add_subcommand("archive", "Copy a recording, compressed without loss");
  archive_command->add_option("recording", recording, "RUN.h5")->required();
  archive_command->add_option("-o,--output", copy, "The copy")->type_name("SMALL.h5")->required();
  archive_command->add_flag("--force", replace, "Replace an existing file");
  CLI::App* keygen_command = app.add_subcommand("keygen", "Make CURVE keys for a server and a client");
  keygen_command->add_option("directory", key_directory, "DIR")->required();

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? protocol::kDone : protocol::kBadInput;
  }

  for (const Forwarded& forwarded : kForwarded)
    if (const CLI::App* command = app.get_subcommand(forwarded.command); command->parsed())
      become(sibling(forwarded.program), command->remaining());
  for (const Forwarded& python : kPython)
    if (const CLI::App* command = app.get_subcommand(python.command); command->parsed())
      become_module(python.program, command->remaining());
  if (python_command->parsed()) become_python(python_command->remaining());
  if (run_command->parsed()) return run(run_options);
  if (resume_command->parsed()) return resume(resume_options);
  if (check_command->parsed()) return check(check_options);
  if (repair_command->parsed()) return repair_file(recording, copy);
  if (archive_command->parsed()) return archive_file(recording, copy, replace);
  if (keygen_command->parsed()) return make_keys(key_directory);
  return inspect_file(recording, json);
}

}  // namespace
}  // namespace sluice::clients

int main(int argc, char** argv) {
  spdlog::set_default_logger(spdlog::stderr_color_mt("sluice"));
  spdlog::set_pattern("[%n] %v");
  try {
    return sluice::clients::front_end(argc, argv);
  } catch (const sluice::protocol::SceneError& error) {
    for (const auto& problem : error.problems()) spdlog::error("{}", sluice::protocol::to_string(problem));
    return sluice::protocol::kBadInput;
  } catch (const sluice::protocol::InputError& error) {
    spdlog::error("{}", error.what());
    return sluice::protocol::kBadInput;
  } catch (const std::exception& error) {
    spdlog::error("{}", error.what());
    return sluice::protocol::kProcessFailed;
  }
}
