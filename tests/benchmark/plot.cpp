#include "benchmark/plot.hpp"

#include <cstdio>
#include <filesystem>
#include <stdexcept>

namespace sluice::benchmark {

namespace {

// A word of a shell command.
std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

}  // namespace

void plot(const std::string& script, const std::string& csv, const std::string& picture) {
  const auto path = std::filesystem::read_symlink("/proc/self/exe").parent_path().parent_path() /
                    "share/sluice/benchmark" / script;
  const std::string command = "/usr/bin/python3 " + quoted(path.string()) + " " + quoted(picture);
  FILE* pipe = popen(command.c_str(), "w");
  if (pipe == nullptr) throw std::runtime_error("cannot start " + command);
  std::fwrite(csv.data(), 1, csv.size(), pipe);
  if (pclose(pipe) != 0) throw std::runtime_error("this failed: " + command);
}

}  // namespace sluice::benchmark
