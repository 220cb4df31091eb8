#pragma once

#include <sys/types.h>

#include <deque>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace sluice::clients {

// A program started by this one, in a process group of its own so that a terminal's Ctrl-C reaches only the
// parent, which decides what to do. It gets SIGTERM when the parent dies. What it writes to stdout and stderr
// is collected; the last lines are kept for a failure report.
class Child {
 public:
  using OnLine = std::function<void(const std::string& line)>;

  // Throws std::system_error when the program cannot be started.
  Child(const std::filesystem::path& program, const std::vector<std::string>& arguments);
  // Kills what still runs.
  ~Child();
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] pid_t pid() const { return pid_; }

  // The readable end of its output, for polling; -1 once it is closed.
  [[nodiscard]] int output() const { return output_; }
  // Takes what it has written so far, without blocking.
  void read_output(const OnLine& on_line = {});
  [[nodiscard]] const std::deque<std::string>& last_lines() const { return last_lines_; }

  // Once it has ended: its exit code, or 128 + n when signal n ended it. Does not block.
  std::optional<int> exit_code();
  // Blocks until it has ended.
  int wait();
  // Nothing happens when it has ended already.
  void signal(int number);

 private:
  void take(std::string line, const OnLine& on_line);

  std::string name_;
  pid_t pid_ = -1;
  int output_ = -1;
  std::string unfinished_line_;
  std::deque<std::string> last_lines_;
  std::optional<int> exit_code_;
};

}  // namespace sluice::clients
