#pragma once

#include <filesystem>
#include <optional>

#include "clients/recording/reader.hpp"
#include "clients/recording/writer.hpp"

namespace sluice::clients {

// Throws InputError unless the recording is that of the run and holds all of it up to the step.
void require_reaches(const Reader& recording, const std::string& run_id, std::uint64_t step,
                     std::uint64_t steps_per_interval);

// The recording of a run that goes on, with what was recorded before.
class Continuation {
 public:
  // From a recorder's Welcome: `output` gets what `recording` holds up to Welcome.done, whatever comes after
  // that, and the writer goes on from there. The two may be one file, which is replaced by take_place().
  // Throws InputError when the recording is being written, damaged before, or not what it must be.
  Continuation(const std::filesystem::path& recording, const std::filesystem::path& output, bool force,
               protocol::Message welcome);

  Writer& writer() { return *writer_; }
  // The run really goes on: from now on the output is at its place. Does nothing the second time.
  void take_place();
  // Whether it is; a recording that never went on is removed instead by abandon().
  [[nodiscard]] bool is_in_place() const { return aside_.empty(); }
  void abandon();

 private:
  std::filesystem::path output_, aside_;
  std::optional<Writer> writer_;
};

}  // namespace sluice::clients
