#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "messages.pb.h"

namespace sluice::clients {

// What a run was and how it ended.
struct Summary {
  std::string scene;
  std::string file;
  unsigned dimension = 2;
  std::uint64_t fluid_particles = 0;
  std::uint64_t boundary_particles = 0;
  std::uint64_t step = 0;         // done
  std::uint64_t steps = 0;        // planned
  std::uint64_t done_before = 0;  // of a run that was resumed
  double time = 0;                // simulated [s]
  double duration = 0;            // planned [s]
  double wall_seconds = 0;
  std::optional<Energy> start, end;
  std::vector<std::string> not_computed;  // not_computed.hpp
  std::string status;                     // name of End.Reason; BAD_INPUT when nothing was started
  std::string detail;
  int exit_code = 0;
  std::string recording;  // path; empty when there is none
  std::uint64_t recording_bytes = 0;

  [[nodiscard]] double particle_steps_per_second() const;
};

// For people: two columns, energies per metre of depth in two dimensions.
std::string to_table(const Summary& summary);
// For programs: one JSON object, SI units, names as in the structure.
std::string to_json(const Summary& summary);

}  // namespace sluice::clients
