#pragma once

#include <fcntl.h>
#include <poll.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <functional>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace sluice::testing {

// A child process, killed at the latest when this goes.
class Child {
 public:
  // A program of the build, its stdout and stderr in a file.
  Child(const std::string& program, std::vector<std::string> arguments, const std::filesystem::path& log)
      : log_(log) {
    arguments.insert(arguments.begin(), std::string(SLUICE_BIN) + "/" + program);
    std::vector<char*> argv;
    for (std::string& argument : arguments) argv.push_back(argument.data());
    argv.push_back(nullptr);
    fork_and([&] {
      const int file = open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
      dup2(file, STDOUT_FILENO);
      dup2(file, STDERR_FILENO);
      execv(argv[0], argv.data());
      _exit(127);
    });
  }

  // A function in a process of its own, which makes its own sockets: none may be inherited.
  explicit Child(const std::function<void()>& body) {
    fork_and([&] {
      try {
        body();
      } catch (const std::exception& error) {
        std::fprintf(stderr, "a test's child: %s\n", error.what());
        _exit(1);
      }
      _exit(0);
    });
  }

  ~Child() {
    if (!status_) {
      ::kill(pid_, SIGKILL);
      wait(std::chrono::seconds(60));
    }
    close(pidfd_);
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  void signal(int number) const { ::kill(pid_, number); }

  // The exit code, or 128 + the signal that ended it; nothing when it still runs after the time.
  std::optional<int> wait(std::chrono::milliseconds time) {
    pollfd item{pidfd_, POLLIN, 0};
    if (!status_ && poll(&item, 1, static_cast<int>(time.count())) == 1) {
      int status = 0;
      waitpid(pid_, &status, 0);
      status_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    }
    return status_;
  }

  [[nodiscard]] std::string log() const {
    std::ifstream file(log_);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
  }

 private:
  template <typename Body>
  void fork_and(const Body& body) {
    pid_ = fork();
    if (pid_ < 0) throw std::runtime_error("fork failed");
    if (pid_ == 0) body();
    pidfd_ = static_cast<int>(syscall(SYS_pidfd_open, pid_, 0));
    if (pidfd_ < 0) throw std::runtime_error("pidfd_open failed");
  }

  pid_t pid_ = -1;
  int pidfd_ = -1;
  std::filesystem::path log_;
  std::optional<int> status_;
};

// Tells another process that something has happened.
class Signal {
 public:
  Signal() {
    if (pipe2(ends_, O_CLOEXEC) != 0) throw std::runtime_error("pipe2 failed");
  }
  ~Signal() {
    close(ends_[0]);
    close(ends_[1]);
  }
  Signal(const Signal&) = delete;
  Signal& operator=(const Signal&) = delete;

  void raise() const {
    if (write(ends_[1], "!", 1) != 1) throw std::runtime_error("write failed");
  }
  [[nodiscard]] bool wait(std::chrono::milliseconds time) const {
    pollfd item{ends_[0], POLLIN, 0};
    return poll(&item, 1, static_cast<int>(time.count())) == 1;
  }

 private:
  int ends_[2];
};

}  // namespace sluice::testing
