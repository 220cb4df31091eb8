#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "protocol/message.hpp"

namespace sluice::clients {

// How a recording ended.
enum class Ending {
  kFinished,      // by its recorder, which has written the reason
  kBeingWritten,  // not yet; the reader sees what was there when it opened the file
  kCutShort,      // the recorder was killed; everything it acknowledged is there
};

// Reads a recording, also one that is still being written or whose writer was killed. Never changes the file.
class Reader {
 public:
  // Throws InputError when the file is absent, no recording, of a newer format, damaged or cut short.
  explicit Reader(const std::filesystem::path& path);
  ~Reader();
  Reader(Reader&&) noexcept;
  Reader& operator=(Reader&&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const;
  [[nodiscard]] Ending ending() const;
  // End.Reason or "server lost" or "interrupted", and its explanation; "running" until finished.
  [[nodiscard]] const std::string& reason() const;
  [[nodiscard]] const std::string& detail() const;
  [[nodiscard]] double wall_seconds() const;

  [[nodiscard]] const std::string& run_id() const;
  // As the server sent it, without the endpoints.
  [[nodiscard]] const Welcome& welcome() const;
  [[nodiscard]] const Scene& scene() const { return welcome().scene(); }
  [[nodiscard]] std::uint64_t frames() const;
  // Steps whose exchange is recorded: 1 .. exchanges().
  [[nodiscard]] std::uint64_t exchanges() const;

  // Step, time, index, hash and energies of a frame, without its arrays.
  [[nodiscard]] Header frame_header(std::uint64_t index) const;

  // Particles in a frame; 0 in one that was to have none (Output.particles_every).
  [[nodiscard]] std::uint64_t particles(std::uint64_t index) const;
  // The most in any.
  [[nodiscard]] std::uint64_t slots() const;

  // The messages that were recorded, bit for bit; the sender's run id and version are set, sequence and token
  // are not. All throw InputError when the bytes are not those that were written.
  [[nodiscard]] protocol::Message welcome_message() const;
  [[nodiscard]] protocol::Message frame(std::uint64_t index) const;
  // Precondition: 1 <= first_step, first_step + count - 1 <= exchanges().
  [[nodiscard]] protocol::Message exchange_log(std::uint64_t first_step, std::uint32_t count) const;

 private:
  class File;
  std::unique_ptr<File> file_;
};

}  // namespace sluice::clients
