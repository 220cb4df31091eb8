#include "protocol/checkpoint_file.hpp"

#include <gmock/gmock.h>

#include <fstream>
#include <random>

#include "protocol/build_id.hpp"
#include "protocol/error.hpp"
#include "temporary_directory.hpp"

namespace sluice::protocol {
namespace {

using testing::AllOf;
using testing::HasSubstr;

CheckpointFile checkpoint(std::uint64_t step, const std::string& run_id = "0123456789abcdef") {
  CheckpointFile file;
  file.header.set_run_id(run_id);
  file.header.set_step(step);
  file.header.mutable_scene()->set_name("gate");
  for (int i = 0; i < 1000; ++i) file.fluid.push_back(static_cast<std::byte>(i * 7));
  file.rigid = {1.5, -0.0, static_cast<double>(step)};
  return file;
}

void write(const std::filesystem::path& path, std::uint64_t step,
           const std::string& run_id = "0123456789abcdef") {
  CheckpointFile file = checkpoint(step, run_id);
  write_checkpoint(path, file);
}

std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void put(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

std::string refusal(const std::filesystem::path& path) {
  try {
    (void)read_checkpoint(path);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(CheckpointFile, ComesBackAsItWasWritten) {
  const TemporaryDirectory directory;
  write(directory / "run.checkpoint", 40);
  const CheckpointFile read = read_checkpoint(directory / "run.checkpoint"), given = checkpoint(40);
  EXPECT_EQ(read.header.step(), 40u);
  EXPECT_EQ(read.header.scene().name(), "gate");
  EXPECT_EQ(read.fluid, given.fluid);
  EXPECT_EQ(read.rigid, given.rigid);
  EXPECT_TRUE(std::signbit(read.rigid[1]));
}

TEST(CheckpointFile, TheOneBeforeIsKept) {
  const TemporaryDirectory directory;
  const auto path = directory / "run.checkpoint";
  for (const std::uint64_t step : {40, 80, 120}) write(path, step);
  EXPECT_EQ(read_checkpoint(path).header.step(), 120u);
  EXPECT_EQ(previous_checkpoint(path), directory / "run.previous.checkpoint");
  EXPECT_EQ(read_checkpoint(previous_checkpoint(path)).header.step(), 80u);
}

TEST(CheckpointFile, NeverKeepsADamagedOneNorThatOfAnotherRun) {
  const TemporaryDirectory directory;
  const auto path = directory / "run.checkpoint";
  write(path, 40);
  write(path, 80);
  put(path, "torn");
  write(path, 120);
  EXPECT_EQ(read_checkpoint(previous_checkpoint(path)).header.step(), 40u);
  write(path, 10, "fedcba9876543210");
  EXPECT_FALSE(std::filesystem::exists(previous_checkpoint(path)));
}

TEST(CheckpointFile, DamageIsRefusedAndTheOneBeforeNamed) {
  const TemporaryDirectory directory;
  const auto path = directory / "run.checkpoint";
  write(path, 40);
  write(path, 80);
  const std::string whole = bytes_of(path);
  std::mt19937 random(20261123);
  for (int i = 0; i < 300; ++i) {
    std::string damaged = whole;
    const std::size_t at = std::uniform_int_distribution<std::size_t>(0, whole.size() - 1)(random);
    SCOPED_TRACE(testing::Message() << "byte " << at << ", case " << i);
    if (i % 3 == 0)
      damaged.resize(at);
    else
      damaged[at] = static_cast<char>(damaged[at] ^ (1 << i % 8));
    put(path, damaged);
    EXPECT_THAT(refusal(path), AllOf(HasSubstr("run.checkpoint"), HasSubstr("run.previous.checkpoint")));
  }
  put(path, whole + "x");
  EXPECT_THAT(refusal(path), HasSubstr("checksum does not fit"));
}

TEST(CheckpointFile, WhatIsNoneIsNamedWithTheReason) {
  const TemporaryDirectory directory;
  EXPECT_THAT(refusal(directory / "absent"), AllOf(HasSubstr("absent"), HasSubstr("No such file")));
  EXPECT_THAT(refusal(directory.path()), HasSubstr("not a regular file"));
  put(directory / "text", "name: \"rising_gate\"");
  EXPECT_THAT(refusal(directory / "text"), HasSubstr("is not a checkpoint"));
  write(directory / "newer", 40);
  std::string bytes = bytes_of(directory / "newer");
  bytes[8] = 2;
  put(directory / "newer", bytes);
  EXPECT_THAT(refusal(directory / "newer"), AllOf(HasSubstr("format 2"), HasSubstr("reads format 1")));
}

TEST(BuildId, IsThatOfTheProgram) {
  EXPECT_THAT(build_id(), testing::MatchesRegex("[0-9a-f]{16,}"));
}

}  // namespace
}  // namespace sluice::protocol
