#include "benchmark/instructions.hpp"

#include <fmt/format.h>
#include <google/protobuf/text_format.h>

#include <cstdio>
#include <filesystem>

#include "benchmark/report.hpp"
#include "benchmark/selection.hpp"
#include "clients/sluice/process.hpp"
#include "clients/sluice/siblings.hpp"
#include "protocol/error.hpp"
#include "validation/support/scene_run.hpp"

namespace sluice::benchmark {
namespace {

constexpr int kParticles = 40, kQuickParticles = 16;  // over the liquid's unit length
constexpr int kFewer = 20, kMore = 60;                // steps; the difference leaves the start out

// Of the whole process.
double instructions_of(const CountedRun& run) {
  std::vector<std::string> words{"--tool=cachegrind",
                                 "--cache-sim=no",
                                 "--cachegrind-out-file=/dev/null",
                                 clients::sibling("sluice-bench").string(),
                                 "steps",
                                 "--feature",
                                 run.feature,
                                 "--particles",
                                 std::to_string(run.particles),
                                 "--steps",
                                 std::to_string(run.steps)};
  if (run.with) words.emplace_back("--with");
  clients::Child child("/usr/bin/valgrind", words);
  std::optional<std::uint64_t> count;
  std::string trouble;  // valgrind's, in its first words
  const auto listen = [&](const std::string& line) {
    if (const auto counted = counted_instructions(line)) count = counted;
    if (trouble.empty() && line.find("Illegal opcode") != std::string::npos) trouble = line;
  };
  const int code = child.wait();
  const std::string how = fmt::format("exit code {}", code);
  child.read_output(listen);
  if (code != 0 || !count)
    throw std::runtime_error(
        fmt::format("valgrind cannot run {}'s scene: {}", run.feature, trouble.empty() ? how : trouble));
  return static_cast<double>(*count);
}

// A particle and step.
double cost_of(const std::string& feature, bool with, int particles) {
  const double difference = instructions_of({feature, with, particles, kMore}) -
                            instructions_of({feature, with, particles, kFewer});
  return difference / (kMore - kFewer) / (particles * particles);
}

}  // namespace

void run_steps(const CountedRun& run) {
  const Feature feature = select(all_features(), {run.feature}, "feature").front();
  Scene scene;
  if (!google::protobuf::TextFormat::ParseFromString(run.with ? feature.with : feature.without, &scene))
    throw std::logic_error("not a scene: feature " + feature.name);
  scene.set_name("feature");
  scene.set_spacing(1.0 / run.particles);
  scene.set_duration(100);
  scene.mutable_output()->set_rate(1);
  validation::SceneRun steps(scene);
  for (int k = 0; k < run.steps; ++k) steps.next_step();
}

std::optional<std::uint64_t> counted_instructions(const std::string& line) {
  const auto colon = line.find(':');
  if (!line.starts_with("==") || line.find(" I ") == std::string::npos || colon == std::string::npos ||
      line.find("refs") == std::string::npos)
    return std::nullopt;
  std::string digits;
  for (const char c : line.substr(colon + 1))
    if (c >= '0' && c <= '9') digits += c;
  if (digits.empty()) return std::nullopt;
  return std::stoull(digits);
}

int instructions(const InstructionOptions& options) {
  if (!std::filesystem::exists("/usr/bin/valgrind"))
    throw protocol::InputError(
        "/usr/bin/valgrind is not there to count instructions; install the package valgrind");
  const int particles = options.quick ? kQuickParticles : kParticles;
  std::string csv = "feature,without,with,ratio\n";
  fmt::print("{:<18}{:>12}{:>12}{:>8}\n", "feature", "without", "with", "ratio");
  for (const Feature& feature : select(all_features(), options.features, "feature")) {
    const double without = cost_of(feature.name, false, particles),
                 with = cost_of(feature.name, true, particles);
    fmt::print("{:<18}{:>12.0f}{:>12.0f}{:>8.3f}\n", feature.name, without, with, with / without);
    std::fflush(stdout);
    csv += fmt::format("{},{:.1f},{:.1f},{:.4f}\n", feature.name, without, with, with / without);
  }
  if (!options.csv.empty()) open_output(options.csv) << csv << std::flush;
  return protocol::kDone;
}

}  // namespace sluice::benchmark
