#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>

#include "benchmark/accuracy.hpp"
#include "benchmark/formulations.hpp"
#include "benchmark/instructions.hpp"
#include "benchmark/recording.hpp"
#include "benchmark/speed.hpp"
#include "benchmark/speed_scenes.hpp"
#include "benchmark/stability.hpp"
#include "protocol/error.hpp"
#include "validation/support/case.hpp"

namespace sluice::benchmark {
namespace {

template <typename Named>
std::string names(const std::vector<Named>& all) {
  std::string text;
  for (const Named& one : all) text += (text.empty() ? "" : ", ") + one.name;
  return text;
}

CLI::App* add_accuracy(CLI::App& app, AccuracyOptions& options) {
  CLI::App* command = app.add_subcommand("accuracy", "Error against a reference and run time, case by case");
  command->add_option("--case", options.cases, "Of: " + names(validation::all_cases()))
      ->type_name("NAME ...");
  command
      ->add_option("--formulation", options.formulations,
                   "Of: " + names(all_formulations()) + "; 'default' alone when left out")
      ->type_name("NAME ...");
  command->add_flag("--quick", options.quick, "Coarse resolutions only; nothing is stated of those");
  command->add_option("--resolution", options.resolutions, "These instead of the cases' own")
      ->check(CLI::PositiveNumber)
      ->excludes("--quick")
      ->type_name("N ...");
  command->add_option("--csv", options.csv, "Write the table to this file")->type_name("FILE");
  command->add_option("--plot", options.plot, "Draw error over run time")->type_name("FILE.png");
  command->add_option("--threads", options.threads, "Threads of the solver")
      ->check(CLI::PositiveNumber)
      ->type_name("N")
      ->capture_default_str();
  return command;
}

CLI::App* add_stability(CLI::App& app, StabilityOptions& options) {
  CLI::App* command =
      app.add_subcommand("stability", "What must not happen in any scene, and how near it is");
  command->add_option("--case", options.checks, "Of: " + names(all_checks()))->type_name("NAME ...");
  command->add_flag("--quick", options.quick, "Seconds instead of half an hour");
  CLI::Option* scenes = command->add_option("--scenes", options.scenes, "Number of random scenes")
                            ->check(CLI::PositiveNumber)
                            ->type_name("N")
                            ->capture_default_str();
  command->add_option("--first-seed", options.first_seed, "Seed of the first; the others follow")
      ->type_name("S")
      ->capture_default_str();
  command
      ->add_option_function<std::uint64_t>(
          "--seed",
          [&options](std::uint64_t seed) {
            options.first_seed = seed;
            options.scenes = 1;
          },
          "The random scene of this seed alone")
      ->excludes(scenes)
      ->excludes("--first-seed")
      ->type_name("S");
  command->add_option("--write", options.write, "Write the random scenes to this directory")
      ->type_name("DIR");
  command->add_option("--csv", options.csv, "Write the tables to this file")->type_name("FILE");
  return command;
}

CLI::App* add_speed(CLI::App& app, SpeedOptions& options) {
  CLI::App* command = app.add_subcommand("speed", "Particle steps a second, and what share of the processor");
  command->add_option("--case", options.cases, "Of: " + names(all_speed_scenes()))->type_name("NAME ...");
  command->add_option("--particles", options.particles, "These numbers instead of the cases' own")
      ->check(CLI::Range(100.0, 1e8))
      ->type_name("N ...");
  command->add_option("--threads", options.threads, "Numbers of threads")
      ->check(CLI::PositiveNumber)
      ->type_name("N ...")
      ->capture_default_str();
  command->add_flag("--quick", options.quick, "The smallest of each case, for seconds");
  command->add_option("--csv", options.csv, "Write the table to this file")->type_name("FILE");
  command->add_option("--plot", options.plot, "Draw speed over size and the stages' shares")
      ->type_name("FILE.png");
  command->add_option("--baseline", options.baseline, "Compare with an earlier table")
      ->check(CLI::ExistingFile)
      ->type_name("FILE");
  return command;
}

CLI::App* add_recording(CLI::App& app, RecordingOptions& options) {
  CLI::App* command = app.add_subcommand("recording", "What frames for a recorder cost the server");
  command->add_option("--particles", options.particles, "Particles of the liquid")
      ->check(CLI::Range(100.0, 1e7))
      ->type_name("N")
      ->capture_default_str();
  command->add_option("--pairs", options.pairs, "Pairs of runs, with a recorder and without")
      ->check(CLI::PositiveNumber)
      ->type_name("N")
      ->capture_default_str();
  command->add_flag("--quick", options.quick, "Few frames; nothing is stated of those");
  command->add_option("--csv", options.csv, "Write the times of every pair to this file")->type_name("FILE");
  return command;
}

CLI::App* add_instructions(CLI::App& app, InstructionOptions& options) {
  CLI::App* command = app.add_subcommand(
      "instructions", "What a feature of a scene costs, in instructions a particle and step");
  command->add_option("--feature", options.features, "Of: " + names(all_features()))->type_name("NAME ...");
  command->add_flag("--quick", options.quick, "Few particles; nothing is to be concluded from those");
  command->add_option("--csv", options.csv, "Write the table to this file")->type_name("FILE");
  return command;
}

// What `instructions` has counted.
CLI::App* add_steps(CLI::App& app, CountedRun& run) {
  CLI::App* command = app.add_subcommand("steps", "")->group("");
  command->add_option("--feature", run.feature)->required();
  command->add_flag("--with", run.with);
  command->add_option("--particles", run.particles)->required();
  command->add_option("--steps", run.steps)->required();
  return command;
}

int bench(int argc, char** argv) {
  CLI::App app{"What the solver's results are worth and what they cost."};
  app.name("sluice bench");
  app.require_subcommand(1);
  app.set_help_flag();
  app.set_help_all_flag("-h,--help", "Print this help message and exit");
  AccuracyOptions of_accuracy;
  const CLI::App* measures_accuracy = add_accuracy(app, of_accuracy);
  StabilityOptions of_stability;
  const CLI::App* checks_stability = add_stability(app, of_stability);
  SpeedOptions of_speed;
  add_speed(app, of_speed);
  RecordingOptions of_recording;
  const CLI::App* measures_recording = add_recording(app, of_recording);
  InstructionOptions of_instructions;
  const CLI::App* counts_instructions = add_instructions(app, of_instructions);
  CountedRun counted;
  const CLI::App* is_counted = add_steps(app, counted);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? protocol::kDone : protocol::kBadInput;
  }
  if (measures_accuracy->parsed()) return accuracy(of_accuracy);
  if (measures_recording->parsed()) return recording(of_recording);
  if (counts_instructions->parsed()) return instructions(of_instructions);
  if (is_counted->parsed()) {
    run_steps(counted);
    return protocol::kDone;
  }
  return checks_stability->parsed() ? stability(of_stability) : speed(of_speed);
}

}  // namespace
}  // namespace sluice::benchmark

int main(int argc, char** argv) {
  spdlog::set_default_logger(spdlog::stderr_color_mt("bench"));
  spdlog::set_pattern("[%n] %v");
  try {
    return sluice::benchmark::bench(argc, argv);
  } catch (const sluice::protocol::InputError& error) {
    spdlog::error("{}", error.what());
    return sluice::protocol::kBadInput;
  } catch (const std::exception& error) {
    spdlog::error("{}", error.what());
    return sluice::protocol::kProcessFailed;
  }
}
