#include "clients/sluice/process.hpp"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <system_error>
#include <utility>

namespace sluice::clients {
namespace {

constexpr std::size_t kKeptLines = 40;
constexpr int kCannotExecute = 127;

[[noreturn]] void throw_errno(const std::string& what) {
  throw std::system_error(errno, std::generic_category(), what);
}

// Between fork and exec: only calls that are safe there.
[[noreturn]] void become(const char* program, char* const* arguments, int output, pid_t parent) {
  setpgid(0, 0);
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (getppid() != parent) _exit(kCannotExecute);  // the parent died before prctl
  dup2(output, STDOUT_FILENO);
  dup2(output, STDERR_FILENO);
  execv(program, arguments);
  _exit(kCannotExecute);
}

int decode(int status) {
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace

Child::Child(const std::filesystem::path& program, const std::vector<std::string>& arguments)
    : name_(program.filename().string()) {
  if (access(program.c_str(), X_OK) != 0) throw_errno("cannot start " + program.string());

  std::string path = program.string();
  std::vector<std::string> words = arguments;
  std::vector<char*> argv{path.data()};
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);

  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) throw_errno("cannot make a pipe for " + name_);
  const pid_t parent = getpid();
  pid_ = fork();
  if (pid_ == 0) become(path.c_str(), argv.data(), ends[1], parent);
  const int error = errno;
  close(ends[1]);
  if (pid_ < 0) {
    close(ends[0]);
    errno = error;
    throw_errno("cannot start " + program.string());
  }
  output_ = ends[0];
  fcntl(output_, F_SETFL, O_NONBLOCK);
}

Child::~Child() {
  if (!exit_code()) {
    signal(SIGKILL);
    wait();
  }
  if (output_ >= 0) close(output_);
}

void Child::take(std::string line, const OnLine& on_line) {
  if (on_line) on_line(line);
  last_lines_.push_back(std::move(line));
  if (last_lines_.size() > kKeptLines) last_lines_.pop_front();
}

void Child::read_output(const OnLine& on_line) {
  std::array<char, 4096> buffer{};
  while (output_ >= 0) {
    const ssize_t got = read(output_, buffer.data(), buffer.size());
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return;  // nothing more for now
    if (got == 0) {
      close(std::exchange(output_, -1));
      if (!unfinished_line_.empty()) take(std::exchange(unfinished_line_, {}), on_line);
      return;
    }
    unfinished_line_.append(buffer.data(), static_cast<std::size_t>(got));
    for (auto end = unfinished_line_.find('\n'); end != std::string::npos;
         end = unfinished_line_.find('\n')) {
      take(unfinished_line_.substr(0, end), on_line);
      unfinished_line_.erase(0, end + 1);
    }
  }
}

std::optional<int> Child::exit_code() {
  int status = 0;
  if (!exit_code_ && waitpid(pid_, &status, WNOHANG) == pid_) exit_code_ = decode(status);
  return exit_code_;
}

int Child::wait() {
  int status = 0;
  while (!exit_code_) {
    if (waitpid(pid_, &status, 0) == pid_) exit_code_ = decode(status);
  }
  return *exit_code_;
}

void Child::signal(int number) {
  if (!exit_code()) kill(pid_, number);
}

}  // namespace sluice::clients
