// A run that is stopped and resumed is the run that was never stopped, to the last bit of its recording.
#include <gmock/gmock.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <sstream>

#include "protocol/checkpoint_file.hpp"
#include "protocol/error.hpp"
#include "tests/end_to_end/recorded_run.hpp"

namespace sluice::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class Resume : public RecordedRun {
 protected:
  using Options = std::vector<std::string>;

  Outcome sluice(const Options& arguments) const { return run_program("sluice", arguments, path("")); }

  static Options joined(Options a, const Options& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
  }

  // Every frame and exchange of both, by the hashes that they were recorded with.
  void expect_same_run(const std::string& a, const std::string& b) const {
    const clients::Reader one = read(a), two = read(b);
    ASSERT_GT(one.frames(), 4u);
    ASSERT_EQ(one.frames(), two.frames());
    ASSERT_EQ(one.exchanges(), two.exchanges());
    EXPECT_EQ(two.reason(), "FINISHED");
    for (std::uint64_t k = 0; k < one.frames(); ++k) {
      const Header first = one.frame(k).header, second = two.frame(k).header;
      EXPECT_EQ(first.frame().SerializeAsString(), second.frame().SerializeAsString()) << "frame " << k;
      EXPECT_EQ(first.time_ns(), second.time_ns());
    }
    constexpr std::uint64_t kAtOnce = 50;
    for (std::uint64_t first = 1; first + kAtOnce <= one.exchanges(); first += kAtOnce)
      ASSERT_EQ(one.exchange_log(first, kAtOnce).hash_arrays(),
                two.exchange_log(first, kAtOnce).hash_arrays())
          << "exchanges from step " << first;
  }

  // Once to the end, and once to the middle, where it is resumed with another number of threads.
  void expect_resumable(const std::string& scene, const Options& options, const std::string& middle,
                        const std::string& end) const {
    run(scene, "whole.h5", joined(options, {"--until", end, "--threads", "1"}));
    run(scene, "part.h5", joined(options, {"--until", middle, "--threads", "1"}));
    const Outcome resumed = sluice({"resume", "part.checkpoint", "--until", end, "--threads", "2"});
    ASSERT_EQ(resumed.code, 0) << resumed.err;
    expect_same_run("whole.h5", "part.h5");
  }
};

TEST_F(Resume, AGateThatIsStreamedAhead) {
  expect_resumable("rising_gate", {"--set", "spacing=0.004"}, "0.05", "0.1");
  const Outcome redriven = redrive("part.h5", "1");
  EXPECT_EQ(redriven.out, "identical\n") << redriven.err;
}

TEST_F(Resume, ARunOfWhichOnlySomeParticlesAreRecorded) {
  expect_resumable("rising_gate",
                   {"--set", "spacing=0.004", "--set", "output.particles_every=3", "--set",
                    "output.region={min: [0.11, 0] max: [0.4, 0.2]}", "--set", "output.precision=FLOAT32",
                    "--set", "output.field=[PRESSURE]"},
                   "0.05", "0.1");
  const clients::Reader recording = read("part.h5");
  EXPECT_GT(recording.particles((recording.frames() - 1) / 3 * 3), 0u);
  EXPECT_LT(recording.slots(), recording.welcome().fluid_particles());
  const Outcome redriven = redrive("part.h5", "1");
  EXPECT_EQ(redriven.out, "identical\n") << redriven.err;
}

// Liquid that comes in and leaves: both parts of the run have particles that the other has not.
TEST_F(Resume, AStreamUnderAGate) {
  expect_resumable("sluice_gate", {"--set", "spacing=0.02"}, "0.6", "1.2");
  const clients::Reader recording = read("part.h5");
  const std::uint64_t last = recording.frames() - 1;
  EXPECT_GT(recording.frame(last).array<std::int64_t>("fluid/id").back(),
            static_cast<std::int64_t>(recording.welcome().fluid_particles()));
  const Outcome redriven = redrive("part.h5", "1");
  EXPECT_EQ(redriven.out, "identical\n") << redriven.err;
}

TEST_F(Resume, AGateThatIsReleasedAndDrops) {
  expect_resumable("dropped_gate", {"--set", "spacing=0.008"}, "0.42", "0.6");
}

TEST_F(Resume, AFloatingBody) {
  expect_resumable("falling_cylinder", {"--set", "spacing=0.022"}, "0.2", "0.35");
}

TEST_F(Resume, ABodyThatComesToLieOnTheFloor) {
  expect_resumable("sinking_block", {"--set", "spacing=0.04", "--set", "body[0].position=[0.5, 0.12]"}, "0.4",
                   "0.8");
}

TEST_F(Resume, AStackInContactInSpace) {
  expect_resumable("box_stack", {"--set", "spacing=0.04"}, "0.1", "0.2");
}

TEST_F(Resume, ABodyThatIsTowedAndLetGo) {
  expect_resumable(
      "falling_cylinder",
      {"--set", "spacing=0.022", "--set", "body[0].prescribed={constant {velocity: [0.4, 0]} release: 0.28}",
       "--set", "body[0].free=[Y_AXIS]"},
      "0.2", "0.35");
  const Outcome redriven = redrive("part.h5", "1");
  EXPECT_EQ(redriven.out, "identical\n") << redriven.err;
}

TEST_F(Resume, JointsWithSpringsAndDampers) {
  expect_resumable("flap_in_waves", {"--set", "spacing=0.08"}, "0.5", "0.9");
}

TEST_F(Resume, IteratedExchangesOfSeveralSteps) {
  expect_resumable("floating_box",
                   {"--set", "spacing=0.03", "--set", "coupling={scheme: IMPLICIT steps_per_exchange: 3}"},
                   "0.1", "0.2");
}

TEST_F(Resume, ExplicitExchangesOfSeveralSteps) {
  expect_resumable("floating_box",
                   {"--set", "spacing=0.03", "--set", "coupling={scheme: EXPLICIT steps_per_exchange: 4}"},
                   "0.1", "0.2");
}

// Starts `sluice` and returns.
pid_t start(std::vector<std::string> arguments) {
  const std::string program = std::string(SLUICE_BIN) + "/sluice";
  arguments.insert(arguments.begin(), "sluice");
  std::vector<char*> argv;
  for (std::string& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);
  const pid_t child = fork();
  if (child == 0) {
    execv(program.c_str(), argv.data());
    _exit(127);
  }
  return child;
}

// Kills a program and all that it has started, without giving them time for last words; when it returns, they
// are gone.
void kill_all(pid_t program) {
  const std::string id = std::to_string(program);
  std::istringstream children(read_text("/proc/" + id + "/task/" + id + "/children"));
  std::vector<pid_t> started;
  for (pid_t child = 0; children >> child;) started.push_back(child);
  prctl(PR_SET_CHILD_SUBREAPER, 1);  // the children become this process's
  kill(program, SIGSTOP);
  for (const pid_t child : started) kill(child, SIGKILL);
  kill(program, SIGKILL);  // the last: its death is a signal to the others
  waitpid(program, nullptr, 0);
  for (const pid_t child : started) waitpid(child, nullptr, 0);
  prctl(PR_SET_CHILD_SUBREAPER, 0);
}

// Everybody is killed, wherever each of them is; the checkpoints are as old as they are.
class ResumeKilled : public Resume {
 protected:
  void expect_resumable_after_kill(const std::string& name, const std::string& until,
                                   const std::string& every, const Options& more) const {
    const Options options = joined({"--threads", "1", "--until", until}, more);
    run(name, "whole.h5", options);
    const std::string scene = std::string(SLUICE_SOURCE) + "/clients/scenes/" + name + ".scene";
    const pid_t program =
        start(joined({"run", scene, "-o", path("killed.h5").string(), "--checkpoint-every", every}, options));
    // Until it has written its second checkpoint.
    while (!std::filesystem::exists(path("killed.previous.checkpoint")))
      ASSERT_EQ(waitpid(program, nullptr, WNOHANG), 0) << "the run ended before it could be killed";
    kill_all(program);
    ASSERT_EQ(read("killed.h5").ending(), clients::Ending::kCutShort);

    const Outcome resumed = sluice({"resume", "killed.checkpoint", "--until", until});
    ASSERT_EQ(resumed.code, 0) << resumed.err;
    expect_same_run("whole.h5", "killed.h5");

    // Also from the one before, of a recording that has gone beyond.
    const Outcome again = sluice({"resume", "killed.previous.checkpoint", "--until", until});
    ASSERT_EQ(again.code, 0) << again.err;
    expect_same_run("whole.h5", "killed.h5");
  }
};

TEST_F(ResumeKilled, WithAFloatingBody) {
  expect_resumable_after_kill("falling_cylinder", "0.35", "0.03", {"--set", "spacing=0.022"});
}

TEST_F(ResumeKilled, WithLiquidThatComesAndGoes) {
  expect_resumable_after_kill("sluice_gate", "1.2", "0.1", {"--set", "spacing=0.02"});
}

// Ctrl-C, as soon as there is a frame to go on from.
TEST_F(Resume, AfterAnInterrupt) {
  const Options options{"--set", "spacing=0.022", "--threads", "1", "--until", "0.2"};
  run("falling_cylinder", "whole.h5", options);
  const std::string scene = std::string(SLUICE_SOURCE) + "/clients/scenes/falling_cylinder.scene";
  const pid_t program = start(joined({"run", scene, "-o", path("part.h5").string()}, options));
  const auto has_frames = [&] {
    try {
      return read("part.h5").frames() > 3;
    } catch (const protocol::InputError&) {
      return false;
    }
  };
  while (!has_frames())
    ASSERT_EQ(waitpid(program, nullptr, WNOHANG), 0) << "the run ended before it could be interrupted";
  kill(program, SIGINT);
  int status = 0;
  waitpid(program, &status, 0);
  ASSERT_EQ(WEXITSTATUS(status), 2);
  EXPECT_THAT(read("part.h5").detail(), HasSubstr("part.checkpoint"));
  const Outcome resumed = sluice({"resume", "part.checkpoint", "--until", "0.2"});
  ASSERT_EQ(resumed.code, 0) << resumed.err;
  expect_same_run("whole.h5", "part.h5");
}

TEST_F(Resume, AnotherRecordingThanTheOneSoFar) {
  run("rising_gate", "part.h5", {"--set", "spacing=0.004", "--until", "0.03"});
  const std::uint64_t before = read("part.h5").frames();
  const Outcome resumed = sluice({"resume", "part.checkpoint", "--until", "0.06", "-o", "more.h5"});
  ASSERT_EQ(resumed.code, 0) << resumed.err;
  EXPECT_EQ(read("part.h5").frames(), before);
  EXPECT_GT(read("more.h5").frames(), before);
}

class RefusedCheckpoint : public Resume {
 protected:
  RefusedCheckpoint() {
    run("falling_cylinder", "run.h5",
        {"--set", "spacing=0.044", "--until", "0.1", "--checkpoint-every", "0.02"});
  }

  // Writes the checkpoint again with something changed; the checksum fits.
  template <typename Change>
  void change(const Change& change) const {
    protocol::CheckpointFile file = protocol::read_checkpoint(path("run.checkpoint"));
    change(file.header);
    protocol::write_checkpoint(path("run.checkpoint"), file);
  }

  // Of `sluice resume`, which leaves the recording as it is.
  [[nodiscard]] std::string refusal(int code = 1) const {
    const std::string before = read_text(path("run.h5"));
    const Outcome outcome = sluice({"resume", "run.checkpoint", "--until", "0.2"});
    EXPECT_EQ(outcome.code, code) << outcome.err;
    EXPECT_TRUE(read_text(path("run.h5")) == before);
    EXPECT_FALSE(std::filesystem::exists(path("run.h5.resumed")));
    return outcome.err;
  }
};

TEST_F(RefusedCheckpoint, OfAnotherBuild) {
  change([](Checkpoint& header) { header.set_server_build("00ff"); });
  EXPECT_THAT(refusal(), AllOf(HasSubstr("another build of sluice-server"), HasSubstr("00ff")));
}

TEST_F(RefusedCheckpoint, OfAnotherBuildOfTheRigidProcess) {
  change([](Checkpoint& header) { header.set_rigid_build("00ff"); });
  EXPECT_THAT(refusal(2), AllOf(HasSubstr("another build of sluice-rigid"), HasSubstr("00ff")));
}

TEST_F(RefusedCheckpoint, OfAnotherProcessor) {
  change([](Checkpoint& header) { header.set_processor_class("pdp-11"); });
  EXPECT_THAT(refusal(), AllOf(HasSubstr("another class of processors"), HasSubstr("pdp-11")));
}

TEST_F(RefusedCheckpoint, OfAnotherRun) {
  change([](Checkpoint& header) { header.set_run_id("0123"); });
  EXPECT_THAT(refusal(), AllOf(HasSubstr("run.h5"), HasSubstr("run 0123")));
}

TEST_F(RefusedCheckpoint, DamagedWithTheOneBeforeNamed) {
  std::filesystem::resize_file(path("run.checkpoint"),
                               std::filesystem::file_size(path("run.checkpoint")) - 1);
  EXPECT_THAT(refusal(), AllOf(HasSubstr("run.checkpoint is damaged"), HasSubstr("run.previous.checkpoint")));
}

TEST_F(RefusedCheckpoint, WithNothingLeftToDo) {
  const Outcome outcome = sluice({"resume", "run.checkpoint", "--until", "0.1"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("nothing left to do"));
}

TEST_F(RefusedCheckpoint, WithoutItsRecording) {
  std::filesystem::remove(path("run.h5"));
  const Outcome outcome = sluice({"resume", "run.checkpoint", "--until", "0.2"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("run.h5"), HasSubstr("--recording")));
}

}  // namespace
}  // namespace sluice::test
