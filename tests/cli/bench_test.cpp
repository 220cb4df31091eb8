// `sluice bench`: what it prints, writes and refuses.
#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "tests/cli/command.hpp"

namespace sluice::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

TEST(Bench, PrintsItsTableAndWritesItsFiles) {
  const TemporaryDirectory directory;
  const Outcome outcome =
      run_program("sluice",
                  {"bench", "accuracy", "--resolution", "8", "6", "--case", "elliptical_drop",
                   "--formulation", "default", "h1.3", "--csv", "a.csv", "--plot", "a.png"},
                  directory.path());
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("elliptical_drop: "), HasSubstr("longer semi-axis"),
                                 HasSubstr("\n  h1.3 "), HasSubstr("particles")));
  const std::string csv = read_text(directory.path() / "a.csv");
  // A line of names, and three figures of two formulations at two resolutions.
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 3 * 2 * 2);
  EXPECT_LT(csv.find("elliptical_drop,default,6,"), csv.find("elliptical_drop,default,8,"));
  EXPECT_THAT(read_text(directory.path() / "a.png"), HasSubstr("PNG"));
}

TEST(Bench, ChecksStability) {
  const TemporaryDirectory directory;
  const Outcome outcome = run_program("sluice",
                                      {"bench", "stability", "--case", "random_scenes", "kernel_sums",
                                       "--seed", "56", "--write", ".", "--csv", "s.csv"},
                                      directory.path());
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out,
              AllOf(HasSubstr("random_scenes: "), HasSubstr("seeds 56 to 56"), HasSubstr("Wendland C2")));
  EXPECT_THAT(read_text(directory.path() / "s.csv"),
              AllOf(HasSubstr("random_scenes,,\"scenes\",\"\",1,,,"), HasSubstr("kernel_sums,")));
  EXPECT_EQ(run_program("sluice", {"check", "seed_56.scene"}, directory.path()).code, 0);
}

TEST(Bench, MeasuresSpeedAndComparesWithItself) {
  const TemporaryDirectory directory;
  const std::vector<std::string> command{"bench",       "speed", "--case",    "dam_break", "dam_break_3d",
                                         "--particles", "2000",  "--threads", "1",         "--quick"};
  const auto run = [&](std::vector<std::string> more) {
    more.insert(more.begin(), command.begin(), command.end());
    return run_program("sluice", more, directory.path());
  };
  const Outcome first = run({"--csv", "a.csv"});
  EXPECT_EQ(first.code, 0) << first.err;
  EXPECT_THAT(first.out, AllOf(HasSubstr("peak of one core"), HasSubstr("dam_break_3d: ")));
  const std::string csv = read_text(directory.path() / "a.csv");
  EXPECT_THAT(csv, AllOf(HasSubstr("scene,particles,threads,rate"), HasSubstr("\ndam_break_3d,2197,1,")));
  EXPECT_THAT(run({"--baseline", "a.csv"}).out, HasSubstr("times baseline"));
  std::ofstream(directory.path() / "b.csv") << csv << "dam_break,many,1\n";
  const Outcome broken = run({"--baseline", "b.csv"});
  EXPECT_EQ(broken.code, 1);
  EXPECT_THAT(broken.err, HasSubstr("b.csv:4: cannot be read"));
}

TEST(Bench, MeasuresWhatFramesCost) {
  const TemporaryDirectory directory;
  const Outcome outcome = run_program(
      "sluice", {"bench", "recording", "--quick", "--particles", "800", "--pairs", "2", "--csv", "r.csv"},
      directory.path());
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("2 pairs of runs"), HasSubstr("a frame [ms]")));
  const std::string csv = read_text(directory.path() / "r.csv");
  EXPECT_THAT(csv, HasSubstr("rate,frames,steps,without_s,with_s\n100,3,"));
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 5);
}

// What counts is valgrind. Without, or where it cannot run the programs, the command says so.
TEST(Bench, CountsInstructions) {
  const TemporaryDirectory directory;
  const Outcome outcome =
      run_program("sluice", {"bench", "instructions", "--quick", "--feature", "viscosity", "--csv", "i.csv"},
                  directory.path());
  if (outcome.code == 0) {
    EXPECT_THAT(outcome.out, HasSubstr("viscosity"));
    EXPECT_THAT(read_text(directory.path() / "i.csv"), HasSubstr("feature,without,with,ratio\nviscosity,"));
  } else if (!std::filesystem::exists("/usr/bin/valgrind")) {
    EXPECT_EQ(outcome.code, 1);
    EXPECT_THAT(outcome.err, HasSubstr("install the package valgrind"));
  } else {
    EXPECT_EQ(outcome.code, 2);
    EXPECT_THAT(outcome.err, HasSubstr("valgrind cannot run viscosity's scene"));
  }
}

TEST(Bench, RefusesChecksThatDoNotExist) {
  const TemporaryDirectory directory;
  const Outcome outcome = run_program("sluice", {"bench", "stability", "--case", "rain"}, directory.path());
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("there is no case 'rain'"), HasSubstr("random_scenes")));
}

TEST(Bench, RefusesWhatDoesNotExist) {
  const TemporaryDirectory directory;
  const auto refusal = [&](const std::vector<std::string>& arguments) {
    std::vector<std::string> all{"bench", "accuracy", "--quick"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    const Outcome outcome = run_program("sluice", all, directory.path());
    EXPECT_EQ(outcome.code, 1);
    return outcome.err;
  };
  EXPECT_THAT(refusal({"--case", "rain"}),
              AllOf(HasSubstr("there is no case 'rain'"), HasSubstr("elliptical_drop")));
  EXPECT_THAT(refusal({"--formulation", "best"}),
              AllOf(HasSubstr("there is no formulation 'best'"), HasSubstr("default")));
  EXPECT_THAT(refusal({"--case", "elliptical_drop", "--csv", "no/where.csv"}),
              AllOf(HasSubstr("no/where.csv"), HasSubstr("existing directory")));
}

}  // namespace
}  // namespace sluice::test
