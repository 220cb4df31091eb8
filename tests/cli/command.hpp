#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace sluice::test {

// A directory of one test, removed with this object.
class TemporaryDirectory {
 public:
  TemporaryDirectory();
  ~TemporaryDirectory();
  TemporaryDirectory(const TemporaryDirectory&) = delete;
  TemporaryDirectory& operator=(const TemporaryDirectory&) = delete;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  std::filesystem::path write(const std::string& name, const std::string& text) const;
  // Names of everything in it, sorted.
  [[nodiscard]] std::vector<std::string> list() const;

 private:
  std::filesystem::path path_;
};

struct Outcome {
  int code = -1;  // exit code, 128 + n for a signal
  std::string out, err;
};

// Runs a program of the build with its arguments in a directory, to its end.
Outcome run_program(const std::string& program, const std::vector<std::string>& arguments,
                    const std::filesystem::path& directory);

// Runs a shell script (sh -eu) in a directory, with `path` in front of PATH; stdout and stderr in `out`.
Outcome run_script(const std::string& script, const std::filesystem::path& directory,
                   const std::filesystem::path& path);

std::string read_text(const std::filesystem::path& file);

}  // namespace sluice::test
