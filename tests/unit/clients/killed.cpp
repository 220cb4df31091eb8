#include "tests/unit/clients/killed.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <system_error>

#include "clients/recording/writer.hpp"

namespace sluice::clients::test {

using std::chrono::steady_clock;

void record_aloud(const FakeRun& run, const std::filesystem::path& path, int pipe, bool force) {
  const auto tell = [&](std::uint64_t frames) {
    if (write(pipe, &frames, sizeof frames) != sizeof frames) _exit(1);
  };
  Writer writer(OutputFile(path, force), run.welcome());
  tell(0);
  for (std::uint64_t index = 0; index <= run.frames; ++index) {
    if (index > 0) writer.write(run.exchange_log(index));
    writer.write(run.frame(index));
    if (index % 4 == 3) continue;
    writer.flush();
    tell(index + 1);
  }
  writer.finish("FINISHED", "");
  tell(kFinished);
}

Killed kill_after(const std::function<void(int pipe)>& action, std::uint64_t frames,
                  std::chrono::microseconds delay) {
  int ends[2];
  if (pipe(ends) != 0) throw std::system_error(errno, std::generic_category());
  const pid_t child = fork();
  if (child == 0) {
    close(ends[0]);
    try {
      action(ends[1]);
    } catch (...) {
      _exit(3);
    }
    _exit(0);
  }
  close(ends[1]);
  Killed result{};
  const auto next = [&] { return read(ends[0], &result.acknowledged, sizeof(std::uint64_t)) > 0; };
  while (next() && result.acknowledged < frames) {
  }
  for (const auto end = steady_clock::now() + delay; steady_clock::now() < end;) {
  }
  kill(child, SIGKILL);
  while (next()) {
  }
  waitpid(child, &result.status, 0);
  close(ends[0]);
  return result;
}

}  // namespace sluice::clients::test
