#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace sluice::benchmark {

struct InstructionOptions {
  std::vector<std::string> features;  // empty: all
  bool quick = false;                 // few particles; nothing is to be concluded from those
  std::string csv;                    // file; empty: none
};

// Something that a scene may need: the same scene, as textproto, that does without it and that has it.
struct Feature {
  std::string name;
  std::string without, with;
};
const std::vector<Feature>& all_features();

// What a step of a feature's scene is counted with: particles over the unit length of its liquid, steps.
struct CountedRun {
  std::string feature;
  bool with = false;
  int particles = 0;
  int steps = 0;
};
// Steps the scene in this process.
void run_steps(const CountedRun& run);

// The number in valgrind's line "==1== I refs: 1,234"; none of another line.
std::optional<std::uint64_t> counted_instructions(const std::string& line);

// Prints the table, writes the file. Returns the exit code. Throws InputError without valgrind, and
// std::runtime_error when a process fails.
int instructions(const InstructionOptions& options);

}  // namespace sluice::benchmark
