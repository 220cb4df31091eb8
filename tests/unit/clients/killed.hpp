#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>

#include "tests/unit/clients/fake_run.hpp"

namespace sluice::clients::test {

inline constexpr std::uint64_t kFinished = ~std::uint64_t{0};

// Records as the recorder does, several messages to a flush, and tells the pipe how many frames are on disk.
void record_aloud(const FakeRun& run, const std::filesystem::path& path, int pipe, bool force = false);

struct Killed {
  std::uint64_t acknowledged;  // frames, or kFinished
  int status;                  // of the process
};

// Runs `action` in a process of its own and kills it `delay` after it has acknowledged `frames`.
Killed kill_after(const std::function<void(int pipe)>& action, std::uint64_t frames,
                  std::chrono::microseconds delay);

}  // namespace sluice::clients::test
