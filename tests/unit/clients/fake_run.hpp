#pragma once

#include <filesystem>
#include <string>

#include "protocol/message.hpp"

namespace sluice::clients::test {

// A directory of its own for every test, removed with all its content.
class TemporaryDirectory {
 public:
  TemporaryDirectory();
  ~TemporaryDirectory();
  TemporaryDirectory(const TemporaryDirectory&) = delete;
  TemporaryDirectory& operator=(const TemporaryDirectory&) = delete;
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

// Messages of a run that never was: any value in them follows from the run's size and the message's number.
struct FakeRun {
  std::uint64_t particles = 50;
  int bodies = 1;
  std::uint64_t steps_per_frame = 3;
  std::uint64_t frames = 20;
  Output output{};  // what frames hold; with a region the number of their particles differs

  [[nodiscard]] protocol::Message welcome() const;
  [[nodiscard]] protocol::Message frame(std::uint64_t index) const;
  // The exchanges of the steps between frame index - 1 and frame index >= 1.
  [[nodiscard]] protocol::Message exchange_log(std::uint64_t index) const;
  // In a frame that has particles.
  [[nodiscard]] std::uint64_t particles_in(std::uint64_t index) const;

 private:
  void add_particles(protocol::Message& message, std::uint64_t index) const;
};

// Records the whole run and finishes the file.
void record(const FakeRun& run, const std::filesystem::path& path);

// Equal in header content and in every bit of every array.
void expect_same(const protocol::Message& actual, const protocol::Message& expected);

std::string bytes_of(const std::filesystem::path& path);
void write_bytes(const std::filesystem::path& path, const std::string& bytes);

}  // namespace sluice::clients::test
