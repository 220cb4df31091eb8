#include "clients/sluice/process.hpp"

#include <gmock/gmock.h>
#include <poll.h>

#include <csignal>
#include <system_error>

namespace sluice::clients {
namespace {

using testing::ElementsAre;

std::vector<std::string> script(const std::string& text) {
  return {"-c", text};
}

// Reads until the child closes its output.
std::vector<std::string> all_lines(Child& child) {
  std::vector<std::string> lines;
  while (child.output() >= 0) {
    pollfd item{child.output(), POLLIN, 0};
    poll(&item, 1, -1);
    child.read_output([&](const std::string& line) { lines.push_back(line); });
  }
  return lines;
}

TEST(Process, BothStreamsComeLineByLine) {
  Child child("/bin/sh", script("echo one; echo two >&2; printf three"));
  EXPECT_THAT(all_lines(child), ElementsAre("one", "two", "three"));
  EXPECT_EQ(child.wait(), 0);
}

TEST(Process, TheLastLinesAreKept) {
  Child child("/bin/sh", script("seq 1 100"));
  all_lines(child);
  ASSERT_EQ(child.last_lines().size(), 40U);
  EXPECT_EQ(child.last_lines().back(), "100");
}

TEST(Process, TellsItsExitCodeOrItsSignal) {
  EXPECT_EQ(Child("/bin/sh", script("exit 3")).wait(), 3);
  EXPECT_EQ(Child("/bin/sh", script("kill -KILL $$")).wait(), 128 + SIGKILL);
}

TEST(Process, RunsUntilItIsTold) {
  Child child("/bin/sh", script("trap 'exit 5' TERM; echo ready; while :; do read _ || sleep 0.01; done"));
  pollfd item{child.output(), POLLIN, 0};
  poll(&item, 1, -1);  // the trap is set
  EXPECT_FALSE(child.exit_code().has_value());
  child.signal(SIGTERM);
  EXPECT_EQ(child.wait(), 5);
  child.signal(SIGTERM);  // nothing to tell any more
  EXPECT_EQ(child.exit_code(), 5);
}

TEST(Process, IsGoneWithItsObject) {
  pid_t pid = 0;
  {
    const Child child("/bin/sh", script("sleep 1000"));
    pid = child.pid();
  }
  EXPECT_EQ(kill(pid, 0), -1);
  EXPECT_EQ(errno, ESRCH);
}

// The parent starts a child that tells its id and waits, then dies: the child's output closes when it is
// gone.
TEST(Process, DiesWithItsParent) {
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  const pid_t parent = fork();
  if (parent == 0) {
    Child child("/bin/sh", script("exec sleep 1000 >&" + std::to_string(ends[1])));
    kill(getpid(), SIGKILL);
  }
  close(ends[1]);
  char byte = 0;
  EXPECT_EQ(read(ends[0], &byte, 1), 0);  // end of file: nobody holds the other end
  close(ends[0]);
}

TEST(Process, AProgramThatIsAbsentIsNamed) {
  try {
    const Child child("/absent/program", {});
    FAIL();
  } catch (const std::system_error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("/absent/program"));
  }
}

}  // namespace
}  // namespace sluice::clients
