#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "clients/recording/reader.hpp"
#include "tests/cli/command.hpp"

namespace sluice::test {

// Runs shipped scenes, coarser and shorter, and reads what was recorded.
class RecordedRun : public testing::Test {
 protected:
  // `sluice run` of clients/scenes/<scene>.scene into <output>; fails the test when it does not finish.
  void run(const std::string& scene, const std::string& output,
           const std::vector<std::string>& options) const {
    std::vector<std::string> arguments{
        "run", std::string(SLUICE_SOURCE) + "/clients/scenes/" + scene + ".scene", "-o", output};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const Outcome outcome = run_program("sluice", arguments, directory_.path());
    ASSERT_EQ(outcome.code, 0) << outcome.err;
  }

  // A shell script with the programs in its path; what it printed. Fails the test when it does not end well.
  std::string script(const std::string& text) const {
    const Outcome outcome = run_script(text, directory_.path(), SLUICE_BIN);
    EXPECT_EQ(outcome.code, 0) << outcome.out;
    return outcome.out;
  }

  [[nodiscard]] std::string bytes(const std::string& file) const {
    return read_text(directory_.path() / file);
  }

  [[nodiscard]] Outcome redrive(const std::string& recording, const std::string& threads) const {
    return run_program("sluice", {"replay", recording, "--redrive", "--threads", threads}, directory_.path());
  }

  [[nodiscard]] clients::Reader read(const std::string& recording) const {
    return clients::Reader(directory_.path() / recording);
  }

  [[nodiscard]] std::filesystem::path path(const std::string& name) const { return directory_.path() / name; }

 private:
  TemporaryDirectory directory_;
};

}  // namespace sluice::test
